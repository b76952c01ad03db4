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
#include <support/json_depth.h>

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

/// The manifest on disk, or null: one that cannot be understood vouches for nothing, its images are made
/// again.
Json Manifest::read() const {
    const fs::path file = folder_ / "manifest.json";
    if (!fs::exists(file)) {
        return nullptr;
    }
    const std::string text = support::read_text(file);
    support::check_json_depth(text, file.string());
    Json json = Json::parse(text, nullptr, false);
    return json.is_object() ? json : Json();
}

std::map<std::string, Json> Manifest::entries() const {
    std::map<std::string, Json> result;
    const Json json = read();
    if (json.contains("images") && json["images"].is_array()) {
        for (const Json& entry : json["images"]) {
            const bool whole = entry.is_object() && entry.contains("file") && entry["file"].is_string() &&
                               entry.contains("sha256") && entry["sha256"].is_string() &&
                               entry.contains("recipe") && entry["recipe"].is_string() &&
                               entry.contains("parameters") && entry["parameters"].is_object();
            if (whole) {
                result[entry_name(entry)] = entry;
            }
        }
    }
    return result;
}

std::string Manifest::contact_sheet_inputs() const {
    const Json json = read();
    const bool noted = json.contains("contact_sheet_inputs") && json["contact_sheet_inputs"].is_string();
    return noted ? json["contact_sheet_inputs"].get<std::string>() : std::string();
}

template <typename Change>
void Manifest::change(const Change& change) {
    const FolderLock lock(folder_);
    auto current = entries();
    Json json = header_;
    json["contact_sheet_inputs"] = contact_sheet_inputs();
    change(current, json);
    json["images"] = Json::array();
    for (const auto& [name, entry] : current) {
        json["images"].push_back(entry);
    }
    support::write_atomically(folder_ / "manifest.json", json.dump(2) + "\n");
}

void Manifest::note_contact_sheet(const std::string& inputs) {
    change([&](auto&, Json& json) { json["contact_sheet_inputs"] = inputs; });
}

void Manifest::keep_only(const std::map<std::string, std::string>& recipes) {
    change([&](auto& entries, Json&) {
        std::erase_if(entries, [&](const auto& item) {
            const auto recipe = recipes.find(item.first);
            return recipe == recipes.end() ||
                   item.second["recipe"].template get<std::string>() != recipe->second;
        });
    });
}

void Manifest::add(const std::string& name, const Json& entry) {
    change([&](auto& entries, Json&) { entries[name] = entry; });
}

Json manifest_entry(const Item& item, const Recipe& recipe, const Outcome& outcome) {
    std::vector<std::string> skipped;
    for (const std::string& pass : outcome.passes_reused) {
        skipped.push_back(pass + ": kept from an earlier image");
    }
    skipped.insert(skipped.end(), outcome.passes_skipped.begin(), outcome.passes_skipped.end());
    return {{"shader", item.shader},
            {"distance", item.distance.name},
            {"azimuth_deg", item.azimuth_deg},
            {"file", item.name() + ".png"},
            {"sha256", ""},
            {"recipe", recipe.digest},
            {"milliseconds", outcome.milliseconds},
            {"passes_run", outcome.passes_run},
            {"passes_skipped", skipped},
            {"counts", outcome.counts},
            {"parameters", recipe.parameters}};
}

} // namespace stimuli
