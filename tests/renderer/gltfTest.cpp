// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <renderer/scene/gltf.h>
#include <support/error.h>
#include <support/file.h>

namespace scene = renderer::scene;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

/// A PNG of one pixel: (10, 20, 30), alpha 77.
constexpr std::array<std::uint8_t, 70> one_pixel_png{
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
    0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x44, 0x41, 0x54, 0x78,
    0xda, 0x63, 0xe0, 0x12, 0x91, 0xf3, 0x05, 0x00, 0x00, 0xf2, 0x00, 0x8a, 0x35, 0x35,
    0x63, 0x39, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

/// A glTF file of two triangles that tests change before they write it.
struct Source {
    Json json;
    std::string buffer;

    Source() {
        const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        const float uvs[] = {0, 0, 1, 0, 1, 1, 0, 1};
        const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
        append(positions, sizeof positions);
        append(uvs, sizeof uvs);
        append(indices, sizeof indices);
        json = Json::parse(R"({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
                {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
            "bufferViews": [
                {"buffer": 0, "byteOffset": 0, "byteLength": 48},
                {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                {"buffer": 0, "byteOffset": 80, "byteLength": 12}]})");
    }
    void append(const void* data, std::size_t size) { buffer.append(static_cast<const char*>(data), size); }

    std::string glb() const {
        Json whole = json;
        whole["buffers"] = {{{"byteLength", buffer.size()}}};
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string binary = buffer;
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        std::string file = "glTF";
        const auto number = [&](std::size_t n) {
            const auto word = static_cast<std::uint32_t>(n);
            file.append(reinterpret_cast<const char*>(&word), 4);
        };
        number(2);
        number(12 + 8 + text.size() + 8 + binary.size());
        number(text.size());
        file += "JSON" + text;
        number(binary.size());
        file += std::string("BIN\0", 4) + binary;
        return file;
    }
};

class GltfTest : public testing::Test {
protected:
    fs::path folder = fs::temp_directory_path() /
                      fmt::format("gltfTest.{}.{}",
                                  testing::UnitTest::GetInstance()->current_test_info()->name(), ::getpid());
    fs::path file = folder / "model.glb";
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    scene::Model load(const std::string& bytes, const scene::ModelOverrides& overrides = {}) const {
        std::ofstream(file, std::ios::binary) << bytes;
        return scene::load_gltf(file, overrides);
    }
    /// The message of the error that a changed file gives.
    std::string error(const std::function<void(Source&)>& change) const {
        Source source;
        change(source);
        try {
            load(source.glb());
        } catch (const support::InputError& found) {
            return found.what();
        }
        return "no error";
    }
};

} // namespace

TEST_F(GltfTest, readsPlacesInMillimetresAndComputesTheRest) {
    const scene::Model model = load(Source().glb());
    ASSERT_EQ(model.meshes.size(), 1u);
    const scene::Mesh& mesh = model.meshes[0];
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(mesh.vertices[2].position_mm, glm::vec3(1000, 1000, 0));
    EXPECT_EQ(mesh.vertices[2].uv, glm::vec2(1, 1));
    EXPECT_NEAR(mesh.vertices[0].normal.z, 1, 1e-6f);
    EXPECT_NEAR(mesh.vertices[0].tangent.x, 1, 1e-6f);
    EXPECT_TRUE(mesh.has_uv);
    EXPECT_EQ(model.digest.size(), 64u);
}

TEST_F(GltfTest, readsIndicesOfAllWidths) {
    for (const int type : {5121, 5123, 5125}) {
        Source source;
        source.buffer.resize(80);
        for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) {
            source.append(&index, type == 5121 ? 1 : type == 5123 ? 2 : 4); // little-endian
        }
        source.json["accessors"][2]["componentType"] = type;
        source.json["bufferViews"][2]["byteLength"] = source.buffer.size() - 80;
        EXPECT_EQ(load(source.glb()).meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}))
            << type;
    }
}

TEST_F(GltfTest, readsStripsFansAndListsWithoutIndices) {
    Source source;
    auto& primitive = source.json["meshes"][0]["primitives"][0];
    primitive.erase("indices");
    primitive["mode"] = 5; // strip
    EXPECT_EQ(load(source.glb()).meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
    primitive["mode"] = 6; // fan
    EXPECT_EQ(load(source.glb()).meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST_F(GltfTest, appliesNodeTransforms) {
    Source source;
    // The child's quarter turn about z comes first, then the parent's scale and shift.
    source.json["nodes"] = Json::parse(R"([{"children": [1], "translation": [10, 0, 0], "scale": [2, 2, 2]},
                                           {"mesh": 0, "rotation": [0, 0, 0.70710678118, 0.70710678118]}])");
    const scene::Model model = load(source.glb());
    const glm::vec3 p = model.meshes[0].vertices[1].position_mm; // (1, 0, 0) becomes (10, 2, 0)
    EXPECT_NEAR(p.x, 10'000, 0.01f);
    EXPECT_NEAR(p.y, 2'000, 0.01f);
}

TEST_F(GltfTest, turnsMirroredTrianglesOver) {
    Source source;
    source.json["nodes"][0]["scale"] = {-1, 1, 1};
    const scene::Mesh mesh = load(source.glb()).meshes[0];
    const auto at = [&](std::size_t i) { return mesh.vertices[mesh.indices[i]].position_mm; };
    EXPECT_GT(glm::cross(at(1) - at(0), at(2) - at(0)).z, 0);
    EXPECT_NEAR(mesh.vertices[0].normal.z, 1, 1e-6f);
}

TEST_F(GltfTest, takesOtherUnitsAndFlippedV) {
    scene::ModelOverrides overrides;
    overrides.metres_per_unit = 0.05;
    overrides.flip_v = true;
    const scene::Mesh mesh = load(Source().glb(), overrides).meshes[0];
    EXPECT_NEAR(mesh.vertices[1].position_mm.x, 50, 1e-4f);
    EXPECT_EQ(mesh.vertices[1].uv, glm::vec2(1, 1));
    const glm::vec3 bitangent =
        glm::cross(mesh.vertices[1].normal, glm::vec3(mesh.vertices[1].tangent)) * mesh.vertices[1].tangent.w;
    EXPECT_NEAR(bitangent.y, 1, 1e-6f); // v now runs down, the bitangent up
}

TEST_F(GltfTest, readsTheStrengthOfTheReflection) {
    const auto model = [&](const char* json) {
        Source source;
        source.append(one_pixel_png.data(), one_pixel_png.size());
        source.json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", 92}, {"byteLength", one_pixel_png.size()}});
        source.json["images"] = Json::parse(R"([{"bufferView": 3, "mimeType": "image/png"}])");
        source.json["textures"] = Json::parse(R"([{"source": 0}])");
        source.json["extensionsUsed"] = {"KHR_materials_specular"};
        source.json["materials"] = {{{"extensions", {{"KHR_materials_specular", Json::parse(json)}}}}};
        source.json["meshes"][0]["primitives"][0]["material"] = 0;
        return load(source.glb());
    };
    const auto material = [&](const char* json) { return model(json).materials[0]; };
    EXPECT_EQ(material("{}").specular_factor, 1);
    EXPECT_EQ(material("{}").specular, nullptr);
    EXPECT_EQ(material(R"({"specularFactor": 0.25})").specular_factor, 0.25f);
    const scene::Material textured = material(R"({"specularTexture": {"index": 0, "texCoord": 0}})");
    ASSERT_NE(textured.specular, nullptr);
    ASSERT_EQ(textured.specular->channels, 4);
    EXPECT_EQ(textured.specular->pixels[3], 77);
    const std::set<std::string> digests{model("{}").digest, model(R"({"specularFactor": 0.25})").digest,
                                        model(R"({"specularTexture": {"index": 0}})").digest};
    EXPECT_EQ(digests.size(), 3U);
}

TEST_F(GltfTest, digestFollowsTheContent) {
    Source changed;
    changed.buffer[3] = 1;
    EXPECT_EQ(load(Source().glb()).digest, load(Source().glb()).digest);
    EXPECT_NE(load(Source().glb()).digest, load(changed.glb()).digest);
}

TEST_F(GltfTest, namesWhatIsWrong) {
    const auto index = [](Source& s, std::uint16_t value) { std::memcpy(&s.buffer[80], &value, 2); };
    const auto number = [](Source& s, float value) { std::memcpy(&s.buffer[0], &value, 4); };
    const auto specular = [](Source& s, const char* json) {
        s.json["materials"] = {{{"extensions", {{"KHR_materials_specular", Json::parse(json)}}}}};
    };
    const std::vector<std::pair<std::function<void(Source&)>, const char*>> cases{
        {[&](Source& s) { index(s, 4); }, "indices: expected numbers below 4"},
        {[&](Source& s) { number(s, std::numeric_limits<float>::quiet_NaN()); }, "expected finite numbers"},
        {[&](Source& s) { number(s, std::numeric_limits<float>::infinity()); }, "expected finite numbers"},
        {[](Source& s) { s.json["accessors"][0]["count"] = 400; }, "expected 400 elements"},
        {[](Source& s) { s.json["accessors"][0]["count"] = 9007199254740991; }, "POSITION: expected"},
        {[](Source& s) { s.json["accessors"][0]["count"] = 3; },
         "expected 3 elements as POSITION has, found 4"},
        {[](Source& s) { s.json["accessors"][0]["byteOffset"] = 4; }, "POSITION: expected 4 elements"},
        {[](Source& s) { s.json["bufferViews"][0]["byteLength"] = 1000; }, "inside a buffer of"},
        {[](Source& s) { s.json["bufferViews"][0]["byteOffset"] = 1000; }, "inside a buffer of"},
        {[](Source& s) { s.json["accessors"][0]["bufferView"] = 7; },
         "expected a buffer view below 3, found 7"},
        {[](Source& s) { s.json["accessors"][0]["type"] = "VEC2"; }, "expected 3 components, found 2"},
        {[](Source& s) { s.json["accessors"][2]["componentType"] = 5126; }, "expected unsigned integers"},
        {[](Source& s) { s.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; },
         "accessor below 3"},
        {[](Source& s) { s.json["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }, "POSITION"},
        {[](Source& s) { s.json["meshes"][0]["primitives"][0]["material"] = 3; }, "material: expected"},
        {[](Source& s) { s.json["meshes"][0]["primitives"][0]["mode"] = 1; }, "expected triangles"},
        {[](Source& s) { s.json["accessors"][2]["count"] = 5; }, "three a triangle"},
        {[](Source& s) { s.json["nodes"][0]["mesh"] = 5; }, "mesh"},
        {[](Source& s) { s.json["scene"] = 5; }, "scene: expected a number below 1, found 5"},
        {[](Source& s) { s.json["nodes"][0]["children"] = {0}; }, "nodes: expected"},
        {[](Source& s) {
             s.json["nodes"][0]["scale"] = {1e300, 1e300, 1e300};
         },
         "found none at"},
        {[](Source& s) { s.json["nodes"] = Json::parse(R"([{"children": [1, 1]}, {"mesh": 0}, {}])"); },
         "node 1 with two parents"},
        {[](Source& s) {
             s.json["nodes"][0]["scale"] = {0, 0, 0};
         },
         "found all of it at one place"},
        {[](Source& s) {
             s.json["materials"] = {{{"normalTexture", {{"index", 0}, {"scale", 1e300}}}}};
         },
         "scale"},
        {[](Source& s) { s.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }, "KHR_draco"},
        {[](Source& s) {
             s.json["images"] = {{{"uri", "nowhere.png"}}};
             s.json["textures"] = {{{"source", 0}}};
             s.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
         },
         "expected the file nowhere.png, found none"},
        {[](Source& s) {
             s.json["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
             s.json["textures"] = {{{"source", 0}}};
             s.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
         },
         "expected a PNG"},
        {[](Source& s) {
             s.json["materials"] = {{{"normalTexture", {{"index", 4}}}}};
         },
         "expected a texture below 0"},
        {[&](Source& s) { specular(s, R"({"specularFactor": 1.5})"); },
         "specularFactor: expected 0 to 1, found 1.5"},
        {[&](Source& s) { specular(s, R"({"specularFactor": "much"})"); }, "specularFactor: expected 0 to 1"},
        {[&](Source& s) { specular(s, R"({"specularTexture": {"index": 3}})"); },
         "expected a texture below 0"},
        {[&](Source& s) { specular(s, R"({"specularTexture": {"texCoord": 0}})"); },
         "specularTexture.index: expected"},
        {[&](Source& s) { specular(s, R"({"specularTexture": {"index": -1}})"); },
         "specularTexture.index: expected"},
        {[&](Source& s) { specular(s, R"({"specularTexture": 7})"); }, "specularTexture.index: expected"},
        {[&](Source& s) { specular(s, R"({"specularTexture": {"index": 0, "texCoord": 1}})"); },
         "another texCoord"},
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const std::string message = error(cases[i].first);
        EXPECT_NE(message.find(cases[i].second), std::string::npos) << "case " << i << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

// However short the file, loading it ends in one error.
TEST_F(GltfTest, refusesEveryTruncation) {
    const std::string whole = Source().glb();
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        EXPECT_THROW(load(whole.substr(0, length)), support::InputError) << length;
    }
    EXPECT_THROW(scene::load_gltf(folder / "missing.glb"), support::InputError);
    EXPECT_THROW(scene::load_gltf(folder), support::InputError);
    EXPECT_THROW(load("not a model at all"), support::InputError);
}

// Values nested so deep that walking them recursively would run out of stack.
TEST_F(GltfTest, refusesDeepNesting) {
    const std::string text = Source().glb();
    const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
    const std::string json = R"({"asset": {"version": "2.0"}, "extras": )" + deep + "}";
    EXPECT_THROW(load(json), support::InputError);
    std::string glb = text.substr(0, 12);
    const auto append_number = [&](std::size_t n) {
        const auto word = static_cast<std::uint32_t>(n);
        glb.append(reinterpret_cast<const char*>(&word), 4);
    };
    append_number(json.size());
    glb += "JSON" + json;
    EXPECT_THROW(load(glb), support::InputError);
}

// A byte changed anywhere gives a model or an error, never a crash.
TEST_F(GltfTest, survivesChangedBytes) {
    const std::string whole = Source().glb();
    for (std::size_t place = 12; place < whole.size(); ++place) {
        std::string changed = whole;
        changed[place] = static_cast<char>(changed[place] ^ (1 << (place % 8)));
        try {
            EXPECT_FALSE(load(changed).meshes.empty());
        } catch (const support::InputError& error) {
            EXPECT_STRNE(error.what(), "");
        }
    }
}
