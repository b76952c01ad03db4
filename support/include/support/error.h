// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace support {

/// Bad usage or bad input; the program ends with exit code 2.
/// The message is one line that names the file, the field or line, what was expected and what was found.
class InputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The work itself failed (no OpenGL, a full disk); the program ends with exit code 1.
class Failure : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An InputError from a format string and its arguments.
template <typename... Args>
InputError input_error(fmt::format_string<Args...> text, Args&&... args) {
    return InputError(fmt::format(text, std::forward<Args>(args)...));
}

/// A Failure from a format string and its arguments.
template <typename... Args>
Failure failure(fmt::format_string<Args...> text, Args&&... args) {
    return Failure(fmt::format(text, std::forward<Args>(args)...));
}

/// The text with control characters and line breaks made visible, so that a message stays one line.
std::string one_line(const std::string& text);

} // namespace support
