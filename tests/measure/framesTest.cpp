// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include <stimuli/setup.h>
#include <support/error.h>

#include "accuracy/settings.h"
#include "frames/bandwidth.h"
#include "frames/frames.h"
#include "frames/scenes.h"
#include "frames/soundness.h"
#include "scratch_folder.h"

namespace {

using measure::EffectRow;
using measure::FramePlace;
using measure::FrameRow;
using measure::FrameScene;
using measure::FramesResult;

FrameRow row(const FramePlace& place, const std::string& shader, int msaa, double time_ms, double over_ts) {
    FrameRow result;
    result.place = place;
    result.shader = shader;
    result.setting = "default";
    result.msaa = msaa;
    result.time_ms = time_ms;
    result.fps_over_ts = over_ts;
    return result;
}

EffectRow effect(std::string_view value, double scattering_ms, long long skin_pixels) {
    EffectRow result;
    result.place = {"effects", "scene", value};
    result.node_ms["ss_full"] = scattering_ms;
    result.skin_pixels = skin_pixels;
    return result;
}

std::string finding_of(const FramesResult& result, const std::string& start) {
    for (const std::string& finding : measure::frame_findings(result)) {
        if (finding.starts_with(start)) {
            return finding;
        }
    }
    return {};
}

/// Write a square of 0.2 m as a glTF model: a head that is quick to make and to render.
std::filesystem::path write_square(const std::filesystem::path& folder) {
    const float floats[] = {-.1f, -.1f, 0, .1f, -.1f, 0, .1f, .1f, 0, -.1f, .1f, 0, 0, 1, 1, 1, 1, 0, 0, 0};
    const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    std::ofstream buffer(folder / "square.bin", std::ios::binary);
    buffer.write(reinterpret_cast<const char*>(floats), sizeof floats);
    buffer.write(reinterpret_cast<const char*>(indices), sizeof indices);
    std::ofstream(folder / "square.gltf") << R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                      {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
        "buffers": [{"uri": "square.bin", "byteLength": 92}]})";
    return folder / "square.gltf";
}

/// A block as large as a head and its shoulders, the head's centre in its upper part.
measure::ModelFacts facts() { return {{{-214, -199, -130}, {214, 199, 130}}, {0, 83, 0}}; }

FrameScene scene(int heads) {
    FrameScene result;
    result.places = {{"table7_2", "heads", "5"}};
    result.heads = heads;
    return result;
}

} // namespace

TEST(FramesTest, headsStandInTheViewEachInItsOwnPlace) {
    constexpr double width_mm = 428, depth_mm = 260;
    for (const double view_mm : {1237.0, 4949.0, 2000.0}) {
        for (const int count : {1, 3, 5, 10}) {
            const auto places = measure::side_by_side(count, width_mm, depth_mm, view_mm);
            ASSERT_EQ(places.size(), static_cast<std::size_t>(count));
            std::set<std::pair<double, double>> different;
            for (const study::Placement& place : places) {
                const auto& [x, y, z] = place.place_mm;
                EXPECT_LE(std::abs(x) + width_mm / 2, view_mm / 2 + 1e-9) << count;
                EXPECT_EQ(y, 0);
                EXPECT_LE(z, 0);
                different.insert({x, z});
                // Who stands behind looks through a gap of the row before.
                for (const study::Placement& other : places) {
                    if (z == 0 && other.place_mm[2] == -1.15 * depth_mm) {
                        EXPECT_GT(std::abs(other.place_mm[0] - x), 0.3 * width_mm) << count;
                    }
                }
            }
            EXPECT_EQ(different.size(), places.size());
        }
    }
}

// The tangent of half of 20 degrees is 0.17633: a picture 720 pixels high shows 0.35265 mm a millimetre of
// distance.
TEST(FramesTest, distancesFillTheirShareOfThePicture) {
    const study::Protocol base = measure::study_of_2009();
    for (const auto& [distance, distance_mm] : {std::pair{measure::HeadDistance::near, 657.9},
                                                {measure::HeadDistance::medium, 1973.6},
                                                {measure::HeadDistance::far, 7894.5}}) {
        FrameScene one = scene(1);
        one.distance = distance;
        const study::Protocol protocol = measure::protocol_of(one, base, facts());
        EXPECT_NEAR(stimuli::distance_mm(protocol, protocol.camera.distances.front()), distance_mm, 0.1);
    }
}

TEST(FramesTest, theScreenHidesEveryHead) {
    FrameScene one = scene(5);
    one.hidden = true;
    const study::Protocol protocol = measure::protocol_of(one, measure::study_of_2009(), facts());
    ASSERT_TRUE(protocol.scene.screen);
    const double eye_mm = stimuli::distance_mm(protocol, protocol.camera.distances.front());
    for (const study::Placement& head : protocol.scene.heads) {
        // The nearest corners of the head's block, seen on the screen's plane.
        EXPECT_GT(protocol.scene.screen->z_mm, head.place_mm[2] + 130);
        const double scale = (eye_mm - protocol.scene.screen->z_mm) / (eye_mm - (head.place_mm[2] + 130));
        EXPECT_LE(scale * (std::abs(head.place_mm[0]) + 214), protocol.scene.screen->width_mm / 2);
        EXPECT_LE(scale * (83 + 199), protocol.scene.screen->height_mm / 2);
    }
}

TEST(FramesTest, scenesHoldEveryRowOfThePapersTables) {
    std::set<std::pair<std::string, int>> rows;
    for (const FrameScene& one : measure::frame_scenes(8, false, true)) {
        for (const FramePlace& place : one.places) {
            rows.insert(
                {std::string(place.table) + ' ' + std::string(place.axis) + ' ' + std::string(place.value),
                 one.samples});
            if (place.axis == "heads" || place.axis == "lights") {
                EXPECT_EQ(std::to_string(place.axis == "heads" ? one.heads : one.lights), place.value);
            }
        }
        EXPECT_EQ(one.shadow_map_size, one.places.front().table == "own" ? 4096 : 512);
    }
    for (const char* heads : {"1", "3", "5"}) {
        EXPECT_TRUE(rows.contains({std::string("table3 heads ") + heads, 4}));
    }
    for (const char* place : {"heads 1", "heads 3", "heads 5", "lights 2", "lights 4", "lights 6",
                              "distance near", "distance medium", "distance far"}) {
        EXPECT_TRUE(rows.contains({std::string("table7_2 ") + place, 1})) << place;
        EXPECT_TRUE(rows.contains({std::string("table7_2 ") + place, 8})) << place;
    }
    for (const char* place : {"ten_heads_far", "five_heads_hidden", "five_heads_outside", "five_busts"}) {
        EXPECT_TRUE(rows.contains({std::string("section7_5 scene ") + place, 1})) << place;
    }
    for (const char* level : {"full", "fifth", "tenth"}) {
        EXPECT_TRUE(rows.contains({std::string("levels ten_heads_far ") + level, 1})) << level;
        EXPECT_TRUE(rows.contains({std::string("levels one_head_medium ") + level, 1})) << level;
    }
}

TEST(FramesTest, eachLevelOfTheHeadIsAModelOfItsOwn) {
    std::set<std::string> models;
    for (const FrameScene& one : measure::frame_scenes(1, true, true)) {
        if (one.level) {
            EXPECT_TRUE(models.insert(one.model_key()).second) << one.name();
        }
    }
    EXPECT_EQ(models.size(), 3U);
    for (const FrameScene& one : measure::frame_scenes(1, false, false)) {
        EXPECT_FALSE(one.level) << one.name();
    }
}

TEST(FramesTest, everySceneComparesWithTheFaithfulTextureSpaceAndReusesNothing) {
    for (const FrameScene& one : measure::frame_scenes(4, false, true)) {
        int compared_with = 0;
        for (const auto& setting : measure::frame_settings(one, measure::study_of_2009())) {
            EXPECT_FALSE(setting.switches.share);
            EXPECT_EQ(setting.time_nodes, one.effects);
            EXPECT_TRUE(setting.methods.ts.unblurred_first);
            compared_with += setting.name == measure::faithful ? 1 : 0;
        }
        EXPECT_EQ(compared_with, one.effects ? 0 : 1) << one.name();
    }
}

// Quotients of the figures in the papers' tables, by hand.
TEST(FramesTest, publishedRatiosAreThoseOfThePapers) {
    using measure::published_fps_over_ts;
    EXPECT_NEAR(*published_fps_over_ts({"table3", "heads", "1"}, "ss_full", true), 1.1154, 1e-4);
    EXPECT_NEAR(*published_fps_over_ts({"table3", "heads", "5"}, "no_sss", true), 4.4444, 1e-4);
    EXPECT_NEAR(*published_fps_over_ts({"table7_2", "distance", "far"}, "ss_full", false), 1.8333, 1e-4);
    EXPECT_NEAR(*published_fps_over_ts({"table7_2", "distance", "near"}, "ss_full", true), 0.7692, 1e-4);
    EXPECT_EQ(*published_fps_over_ts({"table7_2", "lights", "4"}, "ts", true), 1);
    EXPECT_EQ(*published_fps_over_ts({"section7_5", "scene", "ten_heads_far"}, "ss_full", false), 3.6);
    EXPECT_FALSE(published_fps_over_ts({"table3", "heads", "1"}, "ss_full", false));
    EXPECT_FALSE(published_fps_over_ts({"table7_2", "heads", "1"}, "no_sss", true));
}

// One Gaussian at 16 bytes a texel: the surface takes 4 in and 36 out; two passes read 16 + 32 and write 16;
// the sum is read and written. At half the resolution: a quarter of that, and 20 + 5 to halve, 5 + 4 + 32 to
// enlarge.
TEST(FramesTest, blursMoveTheBytesCountedByHand) {
    EXPECT_EQ(measure::blur_bytes({{"gaussians", 1}}, 1, 16), 40 + 2 * 64 + 32);
    EXPECT_EQ(measure::blur_bytes({{"gaussians", 2}, {"gaussians in part", 1}}, 100, 8),
              100 * (40 + 3 * (2 * 48 + 16)));
    EXPECT_EQ(measure::blur_bytes({{"gaussians", 1}, {"gaussians at half resolution", 1}}, 4, 16),
              4 * (40 + 25 + 0.25 * (40 + 160) + 41));
    EXPECT_EQ(measure::blur_texel_bytes(0, true), 16);
    EXPECT_EQ(measure::blur_texel_bytes(0, false), 8);
    EXPECT_EQ(measure::blur_texel_bytes(8, true), 4);
}

TEST(FramesTest, tableHasTheColumnsOfTheFormat) {
    FramesResult result;
    result.rows = {row({"table7_2", "heads", "3"}, "ss_full", 1, 20, 1.25)};
    result.rows.front().published_fps_over_ts = 1.5;
    EXPECT_EQ(
        measure::frames_tsv(result),
        "table\taxis\tvalue\tshader\tmsaa\ttime_ms\ttime_spread_ms\tfps\tfps_over_ts\tpublished_fps_over_ts\t"
        "setting\tpublished_fps\tskin_pixels\n"
        "table7_2\theads\t3\tss_full\t1\t20\t0\t50\t1.25\t1.5\tdefault\tn/a\t0\n");
}

TEST(FramesTest, findingsHoldFiguresAgainstTargets) {
    FramesResult result;
    result.rows = {row({"table3", "heads", "1"}, "ss_full", 4, 20, 1.13),
                   row({"table3", "heads", "3"}, "ss_full", 4, 20, 1.84)};
    result.effects = {effect("one_head_far", 16, 10), effect("one_head_medium", 10, 1000),
                      effect("five_heads_medium", 40, 4500)};
    result.effects.front().scattering_share = 0.16;
    result.empty_over_clear = 1.01;
    result.rows.push_back(row({"table7_2", "distance", "medium"}, "ss_full", 1, 50, 3));
    result.rows.push_back(row({"table7_2", "distance", "medium"}, "ts", 1, 49, 3));
    result.rows.back().setting = "culled";
    const auto reached = [&](const std::string& start) {
        const std::string finding = finding_of(result, start);
        EXPECT_FALSE(finding.empty()) << start;
        return !finding.ends_with("not reached") && finding.ends_with("reached");
    };
    EXPECT_TRUE(reached("table3 heads 1"));
    EXPECT_FALSE(reached("table3 heads 3"));
    EXPECT_FALSE(reached("far"));    // 16 % of the frame
    EXPECT_FALSE(reached("medium")); // 49 / 50 of the frames of ts
    EXPECT_TRUE(reached("empty view"));
    EXPECT_TRUE(reached("from one to five heads")); // 4 times the time for 4.5 times the pixels
    EXPECT_EQ(finding_of(result, "section7_5"), "");
}

TEST(FramesTest, refusesFramesThatAreNotSound) {
    const auto frame = [](float light, float coverage) {
        renderer::scene::Frame result;
        result.width = result.height = 1;
        result.linear = {light, light, light, coverage};
        return result;
    };
    EXPECT_NO_THROW(measure::check_same(frame(1, 1), frame(1, 1), false, "scene"));
    EXPECT_NO_THROW(measure::check_same(frame(0, 0), frame(0, 0), true, "scene"));
    EXPECT_THROW(measure::check_same(frame(1, 1), frame(0.5f, 1), false, "scene"), support::Failure);
    EXPECT_THROW(measure::check_same(frame(0, 0), frame(0, 0), false, "scene"), support::Failure);
    EXPECT_THROW(measure::check_same(frame(1, 1), frame(1, 1), true, "scene"), support::Failure);
    EXPECT_THROW(measure::check_same(frame(NAN, 1), frame(NAN, 1), false, "scene"), support::Failure);
    EXPECT_NO_THROW(measure::check_hidden(frame(1, 1), frame(1, 1), "scene"));
    EXPECT_THROW(measure::check_hidden(frame(1, 1), frame(0.5f, 1), "scene"), support::Failure);
    EXPECT_EQ(measure::covered_pixels(frame(1, 0.25f)), 1);
}

// A small run from end to end: every frame is checked on the way.
TEST(FramesTest, timesSmallScenes) {
    const measure::ScratchFolder folder;
    measure::FramesRequest request;
    request.model_file = write_square(folder.path());
    request.width = 128; // of which the quick run takes half: a far head has three pixels
    request.height = 72;
    request.map_size = 64;
    request.rounds = 1;
    request.quick = true;
    request.tables = {"section7_5", "effects"};
    const FramesResult result = measure::run_frames(request);
    ASSERT_EQ(result.rows.size(), 8U); // hidden and outside: four settings each
    for (const FrameRow& one : result.rows) {
        EXPECT_GT(one.time_ms, 0);
        EXPECT_TRUE(one.fps_over_ts && *one.fps_over_ts > 0);
    }
    ASSERT_EQ(result.effects.size(), 3U);
    for (const EffectRow& one : result.effects) {
        for (const char* node : {"ss_full", "bloom", "depth of field"}) {
            EXPECT_TRUE(one.node_ms.contains(node)) << node;
        }
        EXPECT_GT(one.skin_pixels, 0);
        EXPECT_GT(one.scattering_share, 0);
        EXPECT_LT(one.scattering_share, 10);
        EXPECT_GT(one.blur_share_of_copy, 0);
    }
    EXPECT_GT(result.empty_over_clear, 0);
}
