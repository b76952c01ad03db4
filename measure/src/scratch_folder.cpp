// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "scratch_folder.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <stdlib.h>

#include <support/error.h>

namespace measure {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "skin2afc-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw support::failure("{}: cannot be made: {}", name, std::strerror(errno));
    }
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
}

} // namespace measure
