// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include <support/file.h>

namespace measure {

/// Files that come into place together, in a folder that is made for them; without commit() nothing stays.
class Outputs {
public:
    /// Throws support::InputError if the folder cannot be made or written.
    explicit Outputs(const std::filesystem::path& folder);
    ~Outputs();
    Outputs(const Outputs&) = delete;
    Outputs& operator=(const Outputs&) = delete;

    /// Where to write the file of that name meanwhile.
    std::filesystem::path path(const std::string& name);
    /// Throws support::Failure.
    void write(const std::string& name, const std::string& text);
    void commit();

private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> made_; // the innermost first
    std::list<support::PendingFile> files_;
};

} // namespace measure
