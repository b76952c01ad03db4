// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <study/protocol.h>

#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include <support/file.h>
#include <support/toml_table.h>

#include "checks.h"
#include "session.h"

namespace study {
namespace {

using support::TomlTable;

// The shaders this program has; a protocol may name no other.
constexpr std::array<std::string_view, 5> known_shaders{"no_sss", "ts", "ss_jittered", "ss_full",
                                                        "reference"};

// Bounds that keep one image inside a GPU's texture limits and a test machine's memory.
constexpr int largest_side = 16384;
constexpr std::size_t most_lights = 8, most_heads = 64;

Rgb rgb(TomlTable& table, std::string_view key, double most, const Rgb& fallback) {
    const auto values = table.numbers(key, 3, 0, most, std::vector<double>(fallback.begin(), fallback.end()));
    return {values[0], values[1], values[2]};
}

/// Names stand in file names and log columns, so they are kept to letters and digits.
void check_name(const TomlTable& table, std::string_view key, const std::string& name) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    if (name.empty() || name.size() > 64 || !std::all_of(name.begin(), name.end(), plain)) {
        throw table.error(
            key, fmt::format("expected 1 to 64 letters and digits, found \"{}\"", support::one_line(name)));
    }
}

ImageSettings read_image(TomlTable table) {
    ImageSettings image;
    image.width = table.integer("width", 16, largest_side, image.width);
    image.height = table.integer("height", 16, largest_side, image.height);
    image.samples = table.integer("samples", 1, 64, image.samples);
    if (!std::has_single_bit(static_cast<unsigned>(image.samples))) {
        // Drivers allot powers of two, whatever is asked for.
        throw table.error("samples", fmt::format("expected a power of two, found {}", image.samples));
    }
    image.background = rgb(table, "background", 100, image.background);
    image.exposure = table.number("exposure", 1e-6, 1e6, image.exposure);
    return image;
}

CameraSettings read_camera(TomlTable table) {
    CameraSettings camera;
    camera.fov_deg = table.number("fov_deg", 0.1, 170, camera.fov_deg);
    camera.head_units = table.number("head_units", 1e-6, 1e6, camera.head_units);
    std::vector<std::string> names;
    for (TomlTable& entry : table.tables("distances")) {
        Distance distance{entry.text("name"), entry.number("units", 1e-6, 1e9)};
        check_name(entry, "name", distance.name);
        names.push_back(distance.name);
        camera.distances.push_back(std::move(distance));
    }
    if (camera.distances.empty()) {
        throw table.error("distances", "expected at least one { name = ..., units = ... }, found none");
    }
    check_unique(table, "distances", names);
    return camera;
}

LightSettings read_light(TomlTable table) {
    LightSettings light;
    light.elevation_deg = table.number("elevation_deg", -90, 90, light.elevation_deg);
    for (const double azimuth : table.numbers("azimuths_deg", 0, 0, 359)) {
        if (azimuth != static_cast<int>(azimuth)) {
            throw table.error("azimuths_deg", fmt::format("expected whole degrees, found {}", azimuth));
        }
        light.azimuths_deg.push_back(static_cast<int>(azimuth));
    }
    check_unique(table, "azimuths_deg", light.azimuths_deg);
    light.irradiance = rgb(table, "irradiance", 1e6, {3, 3, 3});
    light.ambient = rgb(table, "ambient", 1e6, light.ambient);
    light.shadow_map_size = table.integer("shadow_map_size", 16, largest_side, light.shadow_map_size);
    light.shadow_softness_mm = table.number("shadow_softness_mm", 0, 100, 0.1);
    if (table.has("further")) {
        for (TomlTable& entry : table.tables("further")) {
            light.further.push_back({entry.number("azimuth_deg", 0, 360),
                                     entry.number("elevation_deg", -90, 90, light.elevation_deg),
                                     rgb(entry, "irradiance", 1e6, {1, 1, 1})});
        }
        if (light.further.size() >= most_lights) {
            throw table.error("further", fmt::format("expected at most {}, found {}", most_lights - 1,
                                                     light.further.size()));
        }
    }
    return light;
}

SkinSettings read_skin(TomlTable table) {
    SkinSettings skin;
    skin.profile = table.word("profile", {"skin_6g_deon2007", "skin_4g_jimenez2010", "marble_4g_jimenez2010"},
                              "skin_6g_deon2007");
    skin.texture_mix = table.number("texture_mix", 0, 1, skin.texture_mix);
    skin.specular_intensity = table.number("specular_intensity", 0, 1, 0.18);
    skin.fresnel_f0 = table.number("fresnel_f0", 0, 1, 0.028);
    skin.roughness = table.number("roughness", 0.02, 1, skin.roughness);
    return skin;
}

StretchSettings read_stretch(TomlTable& table) {
    StretchSettings stretch;
    if (table.has("alpha")) {
        stretch.alpha = table.number("alpha", 0, 1e6);
    }
    if (table.has("beta")) {
        stretch.beta = table.number("beta", 0, 1e9);
    }
    return stretch;
}

bool read_foreshortening(TomlTable& table, const std::string& fallback) {
    return table.word("foreshortening", {"exact", "published"}, fallback) == "exact";
}

JitteredSettings read_jittered(TomlTable table) {
    JitteredSettings jittered;
    jittered.taps = table.integer("taps", 13, 49, jittered.taps);
    if (jittered.taps != 13 && jittered.taps != 25 && jittered.taps != 49) {
        throw table.error("taps", fmt::format("expected 13, 25 or 49, found {}", jittered.taps));
    }
    jittered.unit_mm = table.number("unit_mm", 1e-6, 1000, 0.527);
    jittered.exact_foreshortening = read_foreshortening(table, "exact");
    jittered.stretch = read_stretch(table);
    return jittered;
}

FullSettings read_full(TomlTable table) {
    FullSettings full;
    // The form sets what the other fields are where they are absent.
    const bool published = table.word("form", {"improved", "published"}, "improved") == "published";
    full.taps = table.integer("taps", 7, 25, full.taps);
    if (full.taps % 2 == 0) {
        throw table.error("taps", fmt::format("expected an odd number, found {}", full.taps));
    }
    full.published_taps = table.boolean("published_taps", published);
    if (full.published_taps && full.taps != 7) {
        throw table.error("taps", fmt::format("expected 7, as published, found {}", full.taps));
    }
    full.exact_foreshortening = read_foreshortening(table, published ? "published" : "exact");
    full.reject_gaps = table.boolean("reject_gaps", !published);
    full.target_bits = table.integer("target_bits", 0, 32, full.target_bits);
    if (full.target_bits != 0 && full.target_bits != 8 && full.target_bits != 16 && full.target_bits != 32) {
        throw table.error("target_bits", fmt::format("expected 0, 8, 16 or 32, found {}", full.target_bits));
    }
    full.half_resolution = table.boolean("half_resolution", !published);
    full.weighted_sum =
        table.word("accumulation", {"on_the_fly", "weighted_sum"}, "on_the_fly") == "weighted_sum";
    full.unblurred_first = table.boolean("unblurred_first", full.unblurred_first);
    full.stretch = read_stretch(table);
    return full;
}

ReferenceSettings read_reference(TomlTable table) {
    ReferenceSettings reference;
    reference.samples_per_side = table.integer("samples_per_side", 1, 64, reference.samples_per_side);
    reference.cells_per_sigma = table.number("cells_per_sigma", 0.25, 8, reference.cells_per_sigma);
    if (table.has("profile")) {
        reference.profile =
            table.word("profile", {"skin_6g_deon2007", "skin_4g_jimenez2010", "marble_4g_jimenez2010",
                                   "dipole_skin1", "dipole_skin2", "dipole_marble", "dipole_ketchup",
                                   "dipole_skimmilk", "dipole_wholemilk", "dipole_cream", "burley"});
    }
    const bool burley = reference.profile == "burley";
    const auto three = [&](std::string_view key, double least, double most) -> Rgb {
        const auto v = table.numbers(key, 3, least, most);
        return {v[0], v[1], v[2]};
    };
    if (burley) { // else the two are unknown fields
        reference.burley_albedo = three("burley_albedo", 1e-3, 1);
        reference.burley_mean_free_path_mm = three("burley_mean_free_path_mm", 1e-6, 1e3);
    }
    return reference;
}

std::array<double, 3> read_place(TomlTable& table, std::string_view key) {
    const auto v = table.numbers(key, 3, -1e9, 1e9);
    return {v[0], v[1], v[2]};
}

ModelSettings read_model(TomlTable table) {
    ModelSettings model;
    const auto path = [&](std::string_view key) -> std::optional<fs::path> {
        return table.has(key) ? std::optional<fs::path>(table.text(key)) : std::nullopt;
    };
    model.file = path("file");
    model.base_color = path("base_color");
    model.normal = path("normal");
    model.roughness = path("roughness");
    model.metres_per_unit = table.number("metres_per_unit", 1e-9, 1e9, model.metres_per_unit);
    model.flip_v = table.boolean("flip_v", model.flip_v);
    model.longest_edge_mm = table.number("longest_edge_mm", 0.1, 1e9, model.longest_edge_mm);
    model.head_height_mm = table.number("head_height_mm", 1e-3, 1e9, model.head_height_mm);
    if (table.has("head_centre_mm")) {
        model.head_centre_mm = read_place(table, "head_centre_mm");
    }
    if (table.has("not_skin")) {
        model.not_skin = table.texts("not_skin");
    }
    return model;
}

SceneSettings read_scene(TomlTable table) {
    SceneSettings scene;
    if (table.has("heads")) {
        for (TomlTable& entry : table.tables("heads")) {
            scene.heads.push_back({read_place(entry, "place_mm"), entry.number("turn_deg", -360, 360, 0)});
        }
        if (scene.heads.empty() || scene.heads.size() > most_heads) {
            throw table.error("heads", fmt::format("expected 1 to {} {{ place_mm = ... }}, found {}",
                                                   most_heads, scene.heads.size()));
        }
    }
    if (table.has("screen")) {
        TomlTable screen = table.table("screen");
        scene.screen = {screen.number("z_mm", -1e9, 1e9), screen.number("width_mm", 1e-3, 1e9),
                        screen.number("height_mm", 1e-3, 1e9)};
    }
    return scene;
}

DisplaySettings read_display(TomlTable table) {
    return {table.number("width_mm", 1, 1e6), static_cast<double>(table.integer("width_px", 1, 1000000)),
            table.number("distance_mm", 1, 1e6)};
}

} // namespace

void check_shader(const TomlTable& table, std::string_view key, const std::string& shader) {
    if (std::find(known_shaders.begin(), known_shaders.end(), shader) == known_shaders.end()) {
        throw table.error(key, fmt::format("expected a shader ({}), found \"{}\"",
                                           fmt::join(known_shaders, ", "), support::one_line(shader)));
    }
}

Protocol read_protocol(const fs::path& file) {
    TomlTable root = TomlTable::read(file);
    Protocol protocol;
    protocol.file = file;
    protocol.digest = support::sha256_of_file(file);
    protocol.name = root.text("name");
    check_name(root, "name", protocol.name);
    protocol.title = root.text("title", protocol.name);
    protocol.shaders = root.texts("shaders");
    for (const std::string& shader : protocol.shaders) {
        check_shader(root, "shaders", shader);
    }
    check_unique(root, "shaders", protocol.shaders);
    protocol.image = read_image(root.table("image"));
    protocol.camera = read_camera(root.table("camera"));
    protocol.light = read_light(root.table("light"));
    protocol.skin = read_skin(root.table("skin"));

    TomlTable bloom = root.table("bloom");
    protocol.bloom.strength = bloom.number("strength", 0, 1, protocol.bloom.strength);
    protocol.bloom.sigma_px = bloom.number("sigma_px", 0, 1000, 8);

    TomlTable lens = root.table("lens");
    protocol.lens.aperture_mm = lens.number("aperture_mm", 0, 1e6, protocol.lens.aperture_mm);
    protocol.lens.focus_mm = lens.number("focus_mm", 0, 1e9, protocol.lens.focus_mm);

    TomlTable ts = root.table("ts");
    protocol.ts.map_size = ts.integer("map_size", 16, largest_side, protocol.ts.map_size);
    protocol.ts.unblurred_first = ts.boolean("unblurred_first", protocol.ts.unblurred_first);
    protocol.ts.culled = ts.boolean("culled", protocol.ts.culled);

    protocol.ss_jittered = read_jittered(root.table("ss_jittered"));
    protocol.ss_full = read_full(root.table("ss_full"));
    protocol.reference = read_reference(root.table("reference"));
    protocol.model = read_model(root.table("model"));
    protocol.scene = read_scene(root.table("scene"));
    protocol.session = read_session(root.table("session"), protocol.shaders);
    if (root.has("display")) {
        protocol.display = read_display(root.table("display"));
    }
    root.finish();
    return protocol;
}

std::string stimulus_name(const std::string& shader, const std::string& distance, int azimuth_deg) {
    return fmt::format("{}_{}_{:03d}", shader, distance, azimuth_deg);
}

} // namespace study
