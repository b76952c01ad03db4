// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "scenes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/glm.hpp>

namespace measure {
namespace {

namespace passes = renderer::passes;
using passes::Shader;

// Shoulders may overlap by so much of a model's width.
constexpr double least_spacing = 0.9;
// A row stands so many depths of a model behind the one before it.
constexpr double row_spacing = 1.15;
// The screen is so much larger than what it hides.
constexpr double screen_margin = 1.05;
// Of the lens in scenes with depth of field: wide, so that all but the focus is unsharp.
constexpr double aperture_mm = 50;

// Lights beside the first, which stands at an azimuth of 60 and an elevation of 45 degrees.
const std::array<study::FurtherLight, 5> further_lights{{{300, 20, {0.5, 0.6, 0.8}},
                                                         {20, 60, {0.4, 0.4, 0.4}},
                                                         {120, 30, {0.6, 0.5, 0.4}},
                                                         {240, 10, {0.4, 0.4, 0.6}},
                                                         {345, 70, {0.3, 0.3, 0.3}}}};

FrameScene scene_of(std::vector<FramePlace> places, int block) {
    FrameScene scene;
    scene.places = std::move(places);
    scene.block = block;
    return scene;
}

std::string_view number(int value) {
    constexpr std::array<std::string_view, 7> numbers{"0", "1", "2", "3", "4", "5", "6"};
    return numbers.at(static_cast<std::size_t>(value));
}

/// Table III, and its first scene with the shadow map of our own studies.
void add_table3(std::vector<FrameScene>& scenes, int samples, int block, bool quick) {
    for (const int heads : {1, 3, 5}) {
        if (!quick || heads != 3) {
            FrameScene scene = scene_of({{"table3", "heads", number(heads)}}, block);
            scene.heads = heads;
            scene.lights = 1;
            scene.samples = std::min(samples, 4);
            scene.profile = "skin_6g_deon2007";
            scenes.push_back(scene);
        }
    }
    if (!quick) {
        FrameScene scene = scenes.front();
        scene.places = {{"own", "shadow_map_size", "4096"}};
        scene.shadow_map_size = 4096;
        scenes.push_back(scene);
    }
}

void add_table7_2(std::vector<FrameScene>& scenes, int samples, int block, bool quick) {
    const auto add = [&](std::vector<FramePlace> places, int heads, int lights, HeadDistance distance) {
        FrameScene scene = scene_of(std::move(places), block);
        scene.heads = heads;
        scene.lights = lights;
        scene.distance = distance;
        scene.samples = samples;
        scenes.push_back(scene);
    };
    constexpr std::string_view table = "table7_2";
    add({{table, "heads", "1"}, {table, "lights", "2"}, {table, "distance", "medium"}}, 1, 2,
        HeadDistance::medium);
    add({{table, "distance", "far"}}, 1, 2, HeadDistance::far);
    add({{table, "heads", "5"}}, 5, 2, HeadDistance::medium);
    if (!quick) {
        add({{table, "heads", "3"}}, 3, 2, HeadDistance::medium);
        add({{table, "lights", "4"}}, 1, 4, HeadDistance::medium);
        add({{table, "lights", "6"}}, 1, 6, HeadDistance::medium);
        add({{table, "distance", "near"}}, 1, 2, HeadDistance::near);
    }
}

/// The scenes that section 7.5 tells of.
void add_section7_5(std::vector<FrameScene>& scenes, int block, bool quick) {
    constexpr std::string_view table = "section7_5";
    FrameScene scene = scene_of({{table, "scene", "five_heads_hidden"}}, block);
    scene.heads = 5;
    scene.hidden = true;
    scenes.push_back(scene);
    scene = scene_of({{table, "scene", "five_heads_outside"}}, block);
    scene.heads = 5;
    scene.outside = true;
    scenes.push_back(scene);
    if (!quick) {
        scene = scene_of({{table, "scene", "ten_heads_far"}}, block);
        scene.heads = 10;
        scene.distance = HeadDistance::far;
        scenes.push_back(scene);
        scene = scene_of({{table, "scene", "five_busts"}}, block);
        scene.heads = 5;
        scene.busts = true;
        scene.profile = "marble_4g_jimenez2010";
        scenes.push_back(scene);
    }
}

/// What each effect costs by itself.
void add_effects(std::vector<FrameScene>& scenes, int block, bool quick) {
    const auto add = [&](std::string_view value, int heads, HeadDistance distance) {
        FrameScene scene = scene_of({{"effects", "scene", value}}, block);
        scene.heads = heads;
        scene.distance = distance;
        scene.effects = true;
        scenes.push_back(scene);
    };
    add("one_head_medium", 1, HeadDistance::medium);
    add("five_heads_medium", 5, HeadDistance::medium);
    add("one_head_far", 1, HeadDistance::far);
    if (!quick) {
        add("one_head_near", 1, HeadDistance::near);
        add("three_heads_medium", 3, HeadDistance::medium);
    }
}

/// What triangles cost where heads are small, and where they are not.
void add_levels(std::vector<FrameScene>& scenes, int block, bool quick) {
    constexpr std::array<std::pair<stimuli::HeadDetail, std::string_view>, 3> levels{
        {{stimuli::HeadDetail::full, "full"},
         {stimuli::HeadDetail::fifth, "fifth"},
         {stimuli::HeadDetail::tenth, "tenth"}}};
    for (const auto& [level, name] : levels) {
        FrameScene scene = scene_of({{"levels", "ten_heads_far", name}}, block);
        scene.heads = 10;
        scene.distance = HeadDistance::far;
        scene.level = level;
        scenes.push_back(scene);
        if (!quick) {
            scene.places = {{"levels", "one_head_medium", name}};
            scene.heads = 1;
            scene.distance = HeadDistance::medium;
            scenes.push_back(scene);
        }
    }
}

double view_width_mm(double distance_mm, const study::Protocol& protocol) {
    const double aspect = static_cast<double>(protocol.image.width) / protocol.image.height;
    return 2 * distance_mm * std::tan(glm::radians(protocol.camera.fov_deg) / 2) * aspect;
}

} // namespace

double height_share(HeadDistance distance) {
    return distance == HeadDistance::near ? 1 : distance == HeadDistance::medium ? 1.0 / 3 : 1.0 / 12;
}

std::string_view distance_name(HeadDistance distance) {
    return distance == HeadDistance::near ? "near" : distance == HeadDistance::medium ? "medium" : "far";
}

std::string FrameScene::model_key() const {
    // How many stand in a row depends on the view's width.
    return fmt::format("{} {}{}{}{}", heads, busts ? "busts" : "heads", hidden ? " hidden" : "",
                       heads > 1 ? fmt::format(" {}", distance_name(distance)) : "",
                       level ? fmt::format(" level {}", static_cast<int>(*level)) : "");
}

std::string FrameScene::rig_key() const {
    return fmt::format("{}, {}, {} samples{}", model_key(), profile, samples, effects ? ", effects" : "");
}

std::string FrameScene::name() const {
    const FramePlace& place = places.front();
    return fmt::format("{} {} {}, MSAA {}", place.table, place.axis, place.value, samples);
}

std::vector<FrameScene> frame_scenes(int highest_samples, bool quick, bool levels) {
    std::vector<FrameScene> scenes;
    add_table3(scenes, highest_samples, 0, quick);
    add_table7_2(scenes, 1, 1, quick);
    if (!quick && highest_samples > 1) {
        add_table7_2(scenes, highest_samples, 2, quick);
    }
    add_section7_5(scenes, 3, quick);
    add_effects(scenes, 4, quick);
    if (levels) {
        add_levels(scenes, 5, quick);
    }
    return scenes;
}

std::vector<FrameSetting> frame_settings(const FrameScene& scene, const study::Protocol& protocol) {
    passes::Methods methods;
    methods.ts.map_size = protocol.ts.map_size;
    methods.ts.unblurred_first = true; // as published
    passes::Switches switches;
    switches.share = false; // every frame computes all that it needs
    const std::string own = "default";
    if (scene.effects) {
        return {{Shader::ss_full, own, methods, switches, true}};
    }
    std::vector<FrameSetting> settings{{Shader::no_sss, own, methods, switches},
                                       {Shader::ss_full, own, methods, switches}};
    if (scene.outside) {
        // Out of view, everything is left out, so texture space in its faithful form is the one that culls
        // nothing.
        settings.push_back({Shader::ts, own, methods, switches});
        switches.cull = switches.rectangle = switches.skip_unlit = false;
    }
    settings.push_back({Shader::ts, std::string(faithful), methods, switches});
    if (scene.places.front().table == "table3") {
        settings.push_back({Shader::ss_jittered, own, methods, switches});
    } else if (!scene.outside) {
        methods.ts.culled = true;
        settings.push_back({Shader::ts, std::string(culled), methods, switches});
    }
    return settings;
}

std::vector<study::Placement> side_by_side(int count, double width_mm, double depth_mm,
                                           double view_width_mm) {
    const double room_mm = std::max(view_width_mm - width_mm, 0.0); // for the middles
    const int most = 1 + static_cast<int>(room_mm / (least_spacing * width_mm));
    const int rows = (count + most - 1) / most;
    const int first_row = (count + rows - 1) / rows;
    const double spacing_mm =
        first_row > 1 ? std::min(1.02 * width_mm, room_mm / (first_row - 1)) : 1.02 * width_mm;
    std::vector<study::Placement> places;
    for (int row = 0; static_cast<int>(places.size()) < count; ++row) {
        const int left = count - static_cast<int>(places.size());
        const int in_row = std::clamp(first_row - row % 2, 1, left); // every other row stands in the gaps
        for (int i = 0; i < in_row; ++i) {
            places.push_back({{(i - 0.5 * (in_row - 1)) * spacing_mm, 0, -row * row_spacing * depth_mm}, 0});
        }
    }
    return places;
}

study::Protocol protocol_of(const FrameScene& scene, const study::Protocol& base, const ModelFacts& facts) {
    study::Protocol protocol = base;
    protocol.image.samples = scene.samples;
    protocol.skin.profile = scene.profile;
    protocol.light.shadow_map_size = scene.shadow_map_size;
    protocol.light.further.assign(further_lights.begin(),
                                  further_lights.begin() + std::max(scene.lights - 1, 0));
    protocol.lens.aperture_mm = scene.effects ? aperture_mm : 0;

    const double distance_mm =
        protocol.model.head_height_mm /
        (2 * std::tan(glm::radians(protocol.camera.fov_deg) / 2) * height_share(scene.distance));
    protocol.camera.distances = {{std::string(distance_name(scene.distance)),
                                  distance_mm * protocol.camera.head_units / protocol.model.head_height_mm}};

    const glm::dvec3 low(facts.bounds.low), high(facts.bounds.high);
    protocol.scene.heads =
        side_by_side(scene.heads, high.x - low.x, high.z - low.z, view_width_mm(distance_mm, protocol));
    protocol.model.head_centre_mm = facts.head_centre_mm;
    if (scene.outside) {
        (*protocol.model.head_centre_mm)[0] += 100 * distance_mm;
    }
    if (scene.hidden) {
        double reach_mm = 0;
        for (const study::Placement& head : protocol.scene.heads) {
            reach_mm = std::max(reach_mm, std::abs(head.place_mm[0]));
        }
        const double half_height_mm =
            std::max(high.y - facts.head_centre_mm[1], facts.head_centre_mm[1] - low.y);
        protocol.scene.screen = {high.z + 20, screen_margin * (2 * reach_mm + high.x - low.x),
                                 screen_margin * 2 * half_height_mm};
    }
    return protocol;
}

} // namespace measure
