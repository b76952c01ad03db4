// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <stimuli/render_set.h>
#include <support/file.h>

namespace fs = std::filesystem;
using nlohmann::json;

/// Write a square of 0.2 m as a glTF model: a head that is quick to make and to render.
inline void write_square(const fs::path& file) {
    const float floats[] = {-.1f, -.1f, 0, .1f, -.1f, 0, .1f, .1f, 0, -.1f, .1f, 0, 0, 1, 1, 1, 1, 0, 0, 0};
    const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    std::ofstream buffer(file.parent_path() / "square.bin", std::ios::binary);
    buffer.write(reinterpret_cast<const char*>(floats), sizeof floats);
    buffer.write(reinterpret_cast<const char*>(indices), sizeof indices);
    std::ofstream(file) << R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                      {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
        "buffers": [{"uri": "square.bin", "byteLength": 92}]})";
}

/// The paper's study in small pictures of a square, with changes.
class SmallSetTest : public testing::Test {
protected:
    fs::path folder = fs::temp_directory_path() /
                      fmt::format("smallSetTest.{}.{}",
                                  testing::UnitTest::GetInstance()->current_test_info()->name(), ::getpid());
    fs::path protocol_file = folder / "small.toml";
    fs::path out = folder / "out";

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
        std::string text = support::read_text(PROTOCOLS "/jimenez2009.toml");
        replace(text, "width = 1650", "width = 132");
        replace(text, "height = 988", "height = 79");
        replace(text, "map_size = 1024\n\n", "map_size = 64\n\n"); // of [ts]
        std::ofstream(protocol_file) << text;
        write_square(folder / "square.gltf");
    }
    void TearDown() override { fs::remove_all(folder); }

    static void replace(std::string& text, const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    }
    void change_protocol(const std::string& from, const std::string& to) const {
        std::string text = support::read_text(protocol_file);
        replace(text, from, to);
        std::ofstream(protocol_file) << text;
    }
    stimuli::SetReport render(std::vector<std::string> only = {}, const std::string& shard = "") const {
        stimuli::SetRequest request;
        request.protocol_file = protocol_file;
        request.out = out;
        request.only = std::move(only);
        request.shard = shard;
        request.switches = switches;
        request.model_file = folder / "square.gltf";
        return stimuli::render_set(request);
    }
    /// The whole set without what its switches save.
    stimuli::SetReport render_without(const renderer::passes::Switches& without, bool overlap) const {
        stimuli::SetRequest request;
        request.protocol_file = protocol_file;
        request.out = out;
        request.switches = without;
        request.overlap = overlap;
        request.model_file = folder / "square.gltf";
        return stimuli::render_set(request);
    }
    renderer::passes::Switches switches;

    /// How often a kind of node ran.
    static int runs(const stimuli::SetReport& report, const std::string& node) {
        const auto found = report.costs.find(node);
        return found == report.costs.end() ? 0 : found->second.runs;
    }
    /// The same with linear images.
    stimuli::SetReport render_exr() const {
        stimuli::SetRequest request;
        request.protocol_file = protocol_file;
        request.out = out;
        request.only = {"distance=far", "azimuth=0"};
        request.exr = true;
        request.model_file = folder / "square.gltf";
        return stimuli::render_set(request);
    }
    static std::vector<std::string> rendered(const stimuli::SetReport& report) {
        std::vector<std::string> names;
        for (const stimuli::Outcome& outcome : report.outcomes) {
            if (outcome.rendered) {
                names.push_back(outcome.name);
            }
        }
        return names;
    }
    json manifest() const { return json::parse(support::read_text(out / "manifest.json")); }
    std::map<std::string, std::string> digests() const {
        std::map<std::string, std::string> result;
        const json written = manifest();
        for (const json& image : written["images"]) {
            result[image["file"]] = image["sha256"];
        }
        return result;
    }
};
