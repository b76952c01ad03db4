// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <string>

namespace renderer::gl {

/// A current OpenGL 4.5 core context without a window, through EGL.
class Context {
public:
    /// A hardware device of EGL's device platform where there is one, else the surfaceless platform, else the
    /// default display. Throws support::Failure that says what was found.
    static Context headless();

    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

private:
    struct Egl;
    explicit Context(std::unique_ptr<Egl> egl);
    std::unique_ptr<Egl> egl_;
};

/// What the current context runs on.
struct DriverInfo {
    std::string renderer, vendor, version;
};
DriverInfo driver_info();
/// Whether the current context draws on the CPU.
bool runs_on_cpu();

/// Throws support::Failure, with what was found, unless the current context is OpenGL 4.5 core or later.
void require_opengl_45();

/// Throws support::Failure if OpenGL recorded an error; `where` names the work just done.
void check_errors(const char* where);

} // namespace renderer::gl
