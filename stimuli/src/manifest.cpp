// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "manifest.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <support/error.h>
#include <support/file.h>

namespace stimuli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// An exclusive lock on a folder for as long as it lives.
class FolderLock {
public:
    explicit FolderLock(const fs::path& folder)
        : fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        if (fd_ < 0 || ::flock(fd_, LOCK_EX) != 0) {
            throw support::failure("{}: cannot be locked: {}", folder.string(), std::strerror(errno));
        }
    }
    ~FolderLock() { ::close(fd_); }
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int fd_;
};

std::string entry_name(const Json& entry) {
    return fs::path(entry.at("file").get<std::string>()).stem().string();
}

} // namespace

Manifest::Manifest(fs::path folder, Json header) : folder_(std::move(folder)), header_(std::move(header)) {}

std::map<std::string, Json> Manifest::entries() const {
    std::map<std::string, Json> result;
    const fs::path file = folder_ / "manifest.json";
    if (!fs::exists(file)) {
        return result;
    }
    // A manifest that cannot be understood vouches for nothing: its images are made again.
    const Json json = Json::parse(support::read_text(file), nullptr, false);
    if (json.is_object() && json.contains("images") && json["images"].is_array()) {
        for (const Json& entry : json["images"]) {
            const bool whole = entry.is_object() && entry.contains("file") && entry["file"].is_string() &&
                               entry.contains("sha256") && entry["sha256"].is_string() &&
                               entry.contains("recipe") && entry["recipe"].is_string();
            if (whole) {
                result[entry_name(entry)] = entry;
            }
        }
    }
    return result;
}

template <typename Change>
void Manifest::change(const Change& change) {
    const FolderLock lock(folder_);
    auto current = entries();
    change(current);
    Json json = header_;
    json["images"] = Json::array();
    for (const auto& [name, entry] : current) {
        json["images"].push_back(entry);
    }
    support::write_atomically(folder_ / "manifest.json", json.dump(2) + "\n");
}

void Manifest::keep_only(const std::map<std::string, std::string>& recipes) {
    change([&](auto& entries) {
        std::erase_if(entries, [&](const auto& item) {
            const auto recipe = recipes.find(item.first);
            return recipe == recipes.end() ||
                   item.second["recipe"].template get<std::string>() != recipe->second;
        });
    });
}

void Manifest::add(const std::string& name, const Json& entry) {
    change([&](auto& entries) { entries[name] = entry; });
}

} // namespace stimuli
