// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_cache.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <support/error.h>
#include <support/file.h>

namespace stimuli::head {
namespace {

namespace fs = std::filesystem;
using renderer::scene::Image;
using renderer::scene::ImagePtr;
using renderer::scene::Material;
using renderer::scene::Mesh;
using renderer::scene::Model;

constexpr std::size_t most_kept = 8, digest_length = 64;

/// The user's folder for what can be made again; empty where there is none.
fs::path cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && fs::path(cache).is_absolute()) { // a relative one is to be ignored, the standard says
        return fs::path(cache) / "skin2afc";
    }
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".cache" / "skin2afc" : fs::path();
}

/// Where the head of this code and these settings is kept.
fs::path cache_file(const HeadSettings& settings) {
    const std::string parameters =
        fmt::format("{} {} {} {}", CODE_DIGEST, settings.seed, settings.age_years, settings.melanin);
    const fs::path folder = cache_folder();
    return folder.empty() ? fs::path() : folder / (support::sha256(parameters) + ".head");
}

template <typename T>
void append(std::string& bytes, const std::vector<T>& items) {
    const std::uint64_t count = items.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
}

/// Takes arrays off the front of `bytes`; false when they do not hold what they promise.
template <typename T>
bool take(std::string_view& bytes, std::vector<T>& items) {
    std::uint64_t count = 0;
    if (bytes.size() < sizeof count) {
        return false;
    }
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes.remove_prefix(sizeof count);
    if (count > bytes.size() / sizeof(T)) {
        return false;
    }
    items.resize(count);
    std::memcpy(items.data(), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
    return true;
}

ImagePtr square_image(std::vector<std::uint8_t> pixels, int side, int channels) {
    return std::make_shared<const Image>(Image{side, side, channels, std::move(pixels)});
}

void drop_oldest(const fs::path& folder) {
    std::error_code error;
    std::vector<std::pair<fs::file_time_type, fs::path>> kept;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == ".head") {
            kept.emplace_back(entry.last_write_time(error), entry.path());
        }
    }
    std::sort(kept.rbegin(), kept.rend());
    for (std::size_t i = most_kept; i < kept.size(); ++i) {
        fs::remove(kept[i].second, error);
    }
}

} // namespace

std::optional<Model> read_cached(const HeadSettings& settings) {
    const fs::path file = cache_file(settings);
    std::error_code error;
    if (file.empty() || !fs::is_regular_file(file, error)) {
        return std::nullopt;
    }
    std::vector<std::uint8_t> content;
    try {
        content = support::read_bytes(file);
    } catch (const support::InputError&) { // a cache that cannot be read is none
        return std::nullopt;
    }
    std::string_view bytes(reinterpret_cast<const char*>(content.data()), content.size());
    if (bytes.size() < digest_length ||
        support::sha256(bytes.substr(digest_length)) != bytes.substr(0, digest_length)) {
        return std::nullopt;
    }
    bytes.remove_prefix(digest_length);

    Mesh mesh;
    mesh.has_uv = true;
    std::vector<std::uint8_t> base_color, normal, reflection;
    std::vector<std::int32_t> side;
    if (!take(bytes, mesh.vertices) || !take(bytes, mesh.indices) || !take(bytes, side) || side.size() != 1 ||
        !take(bytes, base_color) || !take(bytes, normal) || !take(bytes, reflection)) {
        return std::nullopt;
    }
    Material skin;
    skin.name = "skin";
    skin.base_color = square_image(std::move(base_color), side.front(), 3);
    skin.normal = square_image(std::move(normal), side.front(), 3);
    skin.roughness = square_image(std::move(reflection), side.front(), 4);
    skin.specular = skin.roughness;
    skin.roughness_factor = 1;
    Model model;
    model.name = "built-in head";
    model.meshes.push_back(std::move(mesh));
    model.materials.push_back(std::move(skin));
    model.digest = renderer::scene::content_digest(model);
    return model;
}

void write_cached(const HeadSettings& settings, const Model& model) {
    const fs::path file = cache_file(settings);
    std::error_code error;
    if (file.empty() || (fs::create_directories(file.parent_path(), error), error)) {
        return;
    }
    const Mesh& mesh = model.meshes.front();
    const Material& skin = model.materials.front();
    std::string bytes;
    append(bytes, mesh.vertices);
    append(bytes, mesh.indices);
    append(bytes, std::vector<std::int32_t>{skin.base_color->width});
    for (const ImagePtr& image : {skin.base_color, skin.normal, skin.roughness}) {
        append(bytes, image->pixels);
    }
    try {
        support::write_atomically(file, support::sha256(bytes) + bytes);
        drop_oldest(file.parent_path());
    } catch (const std::exception&) { // a full disk only costs the time to make the head again
    }
}

} // namespace stimuli::head
