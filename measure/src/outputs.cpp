// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "outputs.h"

#include <fstream>

#include <support/error.h>

namespace measure {

namespace fs = std::filesystem;

Outputs::Outputs(const fs::path& folder) : folder_(fs::absolute(folder).lexically_normal()) {
    for (fs::path path = folder_; !fs::exists(path) && path != path.parent_path();
         path = path.parent_path()) {
        made_.push_back(path);
    }
    support::make_writable_folder(folder_);
}

Outputs::~Outputs() {
    files_.clear();
    std::error_code none;
    for (const fs::path& path : made_) {
        fs::remove(path, none);
    }
}

fs::path Outputs::path(const std::string& name) { return files_.emplace_back(folder_ / name).path(); }

void Outputs::write(const std::string& name, const std::string& text) {
    std::ofstream stream(path(name), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) {
        throw support::failure("{}: cannot be written", (folder_ / name).string());
    }
}

void Outputs::commit() {
    for (support::PendingFile& file : files_) {
        file.commit();
    }
    made_.clear();
}

} // namespace measure
