// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "output.h"

#include <fstream>
#include <list>

#include <support/error.h>
#include <support/file.h>

namespace stats {

void write_together(const std::filesystem::path& folder, const std::map<std::string, std::string>& contents) {
    support::make_writable_folder(folder);
    // A folder in a file's place would stop the renaming halfway.
    for (const auto& [name, content] : contents) {
        if (std::filesystem::is_directory(folder / name)) {
            throw support::input_error("{}: expected a file or nothing, found a folder",
                                       (folder / name).string());
        }
    }
    std::list<support::PendingFile> pending;
    for (const auto& [name, content] : contents) {
        support::PendingFile& file = pending.emplace_back(folder / name);
        std::ofstream stream(file.path(), std::ios::binary);
        stream.write(content.data(), static_cast<std::streamsize>(content.size()));
        stream.close();
        if (!stream) {
            throw support::failure("{}: cannot be written", (folder / name).string());
        }
    }
    for (support::PendingFile& file : pending) {
        file.commit();
    }
}

} // namespace stats
