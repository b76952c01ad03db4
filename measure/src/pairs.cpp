// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "pairs.h"

#include <algorithm>
#include <map>
#include <optional>

#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>
#include <support/json_depth.h>

namespace measure {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The files of one image.
struct Files {
    std::optional<fs::path> png, exr;
    /// What an error calls it.
    std::string name() const { return (png ? *png : *exr).filename().string(); }
};
using Folder = std::map<std::string, Files>; // by stem

Json read_manifest(const fs::path& file) {
    const std::string text = support::read_text(file);
    support::check_json_depth(text, file.string());
    Json json = Json::parse(text, nullptr, false);
    if (!json.is_object() || !json.contains("images") || !json["images"].is_array()) {
        throw support::input_error("{}: expected a manifest of stimuli with a list \"images\", found none",
                                   file.string());
    }
    return json;
}

/// The images that a manifest lists, with the linear ones that it vouches for.
Folder listed(const fs::path& folder) {
    Folder images;
    const fs::path file = folder / "manifest.json";
    const Json manifest = read_manifest(file);
    for (const Json& entry : manifest["images"]) {
        const std::string name = entry.is_object() && entry.contains("file") && entry["file"].is_string()
                                     ? entry["file"].get<std::string>()
                                     : "";
        if (name.empty() || name.find('/') != std::string::npos) {
            throw support::input_error("{}: images[].file: expected a file name, found {}", file.string(),
                                       support::one_line(entry.dump().substr(0, 80)));
        }
        Files& files = images[fs::path(name).stem().string()];
        files.png = folder / name;
        if (entry.contains("exr_sha256")) {
            files.exr = (folder / name).replace_extension(".exr");
        }
    }
    return images;
}

/// All images of a folder without a manifest.
Folder found(const fs::path& folder) {
    Folder images;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const std::string extension = entry.path().extension().string();
        if (name.starts_with('.') || name == "contact_sheet.png") {
            continue;
        }
        if (extension == ".png") {
            images[entry.path().stem().string()].png = entry.path();
        } else if (extension == ".exr") {
            images[entry.path().stem().string()].exr = entry.path();
        }
    }
    return images;
}

Folder images_of(const fs::path& folder, bool png_only) {
    Folder images = fs::exists(folder / "manifest.json") ? listed(folder) : found(folder);
    if (png_only) {
        std::erase_if(images, [](const auto& item) { return !item.second.png; });
        for (auto& [stem, files] : images) {
            files.exr.reset();
        }
    }
    if (images.empty()) {
        throw support::input_error("{}: expected PNG or OpenEXR images, found none", folder.string());
    }
    return images;
}

/// The stem of the twin: the same, or the same view of another shader; nothing if the image is of that
/// shader.
std::optional<std::string> twin_stem(const std::string& stem, const PairingRules& rules,
                                     const fs::path& folder) {
    if (rules.against.empty()) {
        return stem;
    }
    // SHADER_DISTANCE_AZIMUTH; a shader's name may hold underscores, the others do not.
    const std::size_t last = stem.rfind('_');
    const std::size_t middle = last == std::string::npos || last == 0 ? last : stem.rfind('_', last - 1);
    if (middle == std::string::npos || middle == 0) {
        throw support::input_error("{}: expected names such as ts_near_060 for --against, found {}",
                                   folder.string(), support::one_line(stem));
    }
    return stem.substr(0, middle) == rules.against ? std::nullopt
                                                   : std::optional(rules.against + stem.substr(middle));
}

Pair paired(const std::string& stem, const Files& image, const Files& reference) {
    if (image.exr && reference.exr) {
        return {stem, *image.exr, *reference.exr};
    }
    if (image.png && reference.png) {
        return {stem, *image.png, *reference.png};
    }
    throw support::input_error("{}: expected a twin of the same kind, found {}",
                               (image.png ? *image.png : *image.exr).string(), reference.name());
}

std::vector<Pair> pairs_of_folders(const fs::path& image, const fs::path& reference,
                                   const PairingRules& rules) {
    const Folder images = images_of(image, rules.png_only);
    Folder references = images_of(reference, rules.png_only);
    std::vector<Pair> pairs;
    std::map<std::string, bool> met;
    for (const auto& [stem, files] : images) {
        const std::optional<std::string> twin = twin_stem(stem, rules, image);
        if (!twin) {
            continue;
        }
        const auto other = references.find(*twin);
        if (other == references.end()) {
            throw support::input_error("{}: expected {}, the twin of {}, found none", reference.string(),
                                       rules.against.empty() ? files.name() : *twin + ".png",
                                       (image / files.name()).string());
        }
        pairs.push_back(paired(stem, files, other->second));
        met[*twin] = true;
    }
    for (const auto& [stem, files] : references) {
        if (rules.against.empty() && !met.contains(stem)) {
            throw support::input_error("{}: expected {}, the twin of {}, found none", image.string(),
                                       files.name(), (reference / files.name()).string());
        }
    }
    if (pairs.empty()) {
        throw support::input_error("{}: expected images of other shaders than {}, found none", image.string(),
                                   support::one_line(rules.against));
    }
    return pairs;
}

} // namespace

std::vector<Pair> find_pairs(const fs::path& image, const fs::path& reference, const PairingRules& rules) {
    const bool folder = fs::is_directory(image);
    if (folder != fs::is_directory(reference) && fs::exists(image) && fs::exists(reference)) {
        throw support::input_error("{}: expected a {} as {} is one, found a {}", reference.string(),
                                   folder ? "folder" : "file", image.string(), folder ? "file" : "folder");
    }
    if (folder) {
        return pairs_of_folders(image, reference, rules);
    }
    if (!rules.against.empty()) {
        throw support::input_error("--against: expected two folders, found the file {}", image.string());
    }
    return {{image.stem().string(), image, reference}};
}

} // namespace measure
