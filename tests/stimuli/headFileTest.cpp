// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>

#include <OpenImageIO/imageio.h>

#include <head_cache.h>
#include <head_thickness.h>
#include <renderer/scene/gltf.h>
#include <stimuli/setup.h>

#include "head_under_test.h"
#include "small_set.h"

namespace {

using renderer::scene::Mesh;
using renderer::scene::Model;
using renderer::scene::Vertex;
using stimuli::HeadDetail;

class HeadFileTest : public SmallSetTest {
protected:
    fs::path file = folder / "head.glb";
    /// The head's file, made once for all tests of it.
    void SetUp() override {
        SmallSetTest::SetUp();
        static const std::vector<std::uint8_t> written = [&] {
            stimuli::write_head(head(), file);
            return support::read_bytes(file);
        }();
        support::write_atomically(file, std::string(written.begin(), written.end()));
    }
    std::vector<unsigned char> picture(const std::optional<fs::path>& model) const {
        stimuli::SetRequest request;
        request.protocol_file = protocol_file;
        request.out = out / (model ? "file" : "built_in");
        request.only = {"shader=ss_full", "distance=near", "azimuth=60"};
        request.model_file = model;
        stimuli::render_set(request);
        const auto image = OIIO::ImageInput::open((request.out / "ss_full_near_060.png").string());
        std::vector<unsigned char> pixels(static_cast<std::size_t>(132 * 79 * 3));
        EXPECT_TRUE(image && image->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
        return pixels;
    }
};

TEST_F(HeadFileTest, holdsTheHeadWithAllItsMaps) {
    const Model loaded = renderer::scene::load_gltf(file);
    ASSERT_EQ(loaded.meshes.size(), 1U);
    EXPECT_EQ(loaded.meshes.front().indices, mesh().indices);
    ASSERT_EQ(loaded.meshes.front().vertices.size(), mesh().vertices.size());
    for (std::size_t i = 0; i < mesh().vertices.size(); ++i) {
        const Vertex &written = mesh().vertices[i], &read = loaded.meshes.front().vertices[i];
        // Two roundings to single precision, of metres and of millimetres.
        ASSERT_LT(glm::distance(read.position_mm, written.position_mm), 6e-5F);
        ASSERT_EQ(read.uv, written.uv);
        ASSERT_LT(glm::distance(read.normal, written.normal), 1e-6F);
        ASSERT_LT(glm::distance(read.tangent, written.tangent), 1e-5F);
    }
    const auto &read = loaded.materials.front(), &written = head().materials.front();
    EXPECT_EQ(read.base_color->pixels, written.base_color->pixels);
    EXPECT_EQ(read.normal->pixels, written.normal->pixels);
    EXPECT_EQ(read.roughness->pixels, written.roughness->pixels);
    EXPECT_EQ(read.roughness_factor, written.roughness_factor);
    EXPECT_EQ(read.specular->pixels, written.specular->pixels);
    EXPECT_EQ(read.specular_factor, 1);
}

TEST_F(HeadFileTest, isInMetresAndSaysHowThickTheFleshIs) {
    const std::vector<std::uint8_t> bytes = support::read_bytes(file);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    ASSERT_EQ(text.substr(0, 4), "glTF");
    const std::size_t size = bytes[12] + (std::size_t{bytes[13]} << 8) + (std::size_t{bytes[14]} << 16);
    const json gltf = json::parse(text.substr(20, size));
    const json& place =
        gltf["accessors"][gltf["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
    EXPECT_NEAR(place["max"][1].get<double>(), 0.116, 1e-4) << "the vertex, half a head above the eyes";
    EXPECT_EQ(gltf["materials"][0]["extensions"]["KHR_materials_volume"]["thicknessFactor"], 0.04);
    EXPECT_EQ(gltf["images"].size(), 4U);
}

TEST_F(HeadFileTest, showsThePictureOfTheBuiltInHead) {
    const auto built_in = picture(std::nullopt), loaded = picture(file);
    int most = 0, brightest = 0;
    for (std::size_t i = 0; i < built_in.size(); ++i) {
        most = std::max(most, std::abs(built_in[i] - loaded[i]));
        brightest = std::max(brightest, static_cast<int>(built_in[i]));
    }
    EXPECT_LE(most, 1) << "places differ by a rounding";
    EXPECT_GT(brightest, 80);
}

TEST(HeadLevelsTest, keepVerticesAsTheyWereAndTheSurfaceClosed) {
    const auto key = [](const Vertex& v) {
        return std::make_tuple(v.position_mm.x, v.position_mm.y, v.position_mm.z, v.normal.x, v.tangent.x,
                               v.uv.x, v.uv.y);
    };
    std::set<decltype(key(Vertex{}))> originals;
    for (const Vertex& vertex : mesh().vertices) {
        originals.insert(key(vertex));
    }
    for (const auto& [detail, parts] : {std::pair{HeadDetail::fifth, 5U}, {HeadDetail::tenth, 10U}}) {
        const Model simple = stimuli::simplified(head(), detail);
        const Mesh& small = simple.meshes.front();
        // The poles' fans, whose vertices share a place, collapse less willingly: a tenth more is allowed.
        EXPECT_LE(small.indices.size(), mesh().indices.size() / parts * 11 / 10);
        EXPECT_GE(small.indices.size(), mesh().indices.size() / parts * 9 / 10);
        for (const Vertex& vertex : small.vertices) {
            ASSERT_EQ(originals.count(key(vertex)), 1U);
        }
        std::multiset<std::array<float, 6>> edges;
        for (std::size_t i = 0; i < small.indices.size(); ++i) {
            const glm::vec3 a = small.vertices[small.indices[i]].position_mm,
                            b = small.vertices[small.indices[i % 3 == 2 ? i - 2 : i + 1]].position_mm;
            edges.insert({a.x, a.y, a.z, b.x, b.y, b.z});
        }
        for (const auto& [ax, ay, az, bx, by, bz] : edges) {
            ASSERT_EQ(edges.count({bx, by, bz, ax, ay, az}), edges.count({ax, ay, az, bx, by, bz}))
                << "open edge";
        }
        EXPECT_NE(simple.digest, head().digest);
    }
}

TEST(HeadLevelsTest, standInAProtocolsScene) {
    study::Protocol protocol = study::read_protocol(fs::path(PROTOCOLS) / "jimenez2009.toml");
    protocol.scene.heads = {{{-200, 0, 0}, 0}, {{0, 0, 0}, 0}, {{200, 0, 0}, 0}};
    const Model heads = stimuli::load_head(protocol, stimuli::HeadDetail::tenth);
    std::size_t triangles = 0;
    for (const renderer::scene::Mesh& one : heads.meshes) {
        triangles += one.indices.size() / 3;
    }
    // As many as simplifying leaves in one head, which is a few less than a tenth.
    EXPECT_LE(triangles, 3 * (mesh().indices.size() / 3 / 10));
    EXPECT_GT(triangles, 3 * (mesh().indices.size() / 3 / 11));
}

TEST(HeadThicknessTest, ofABallIsWhatGeometrySays) {
    // Chords of a ball at an angle t to the normal are 2 r cos t; their harmonic mean over 60 degrees is r /
    // ln 2.
    Mesh ball;
    constexpr int rings = 48;
    constexpr float radius_mm = 10;
    for (int j = 0; j <= rings; ++j) {
        for (int i = 0; i <= 2 * rings; ++i) {
            const float turn = glm::radians(180.0F) * static_cast<float>(i) / rings,
                        tilt = glm::radians(180.0F) * static_cast<float>(j) / rings;
            Vertex vertex;
            vertex.normal = {std::sin(tilt) * std::sin(turn), std::cos(tilt),
                             std::sin(tilt) * std::cos(turn)};
            vertex.position_mm = radius_mm * vertex.normal;
            vertex.tangent = {std::cos(turn), 0, -std::sin(turn), 1};
            ball.vertices.push_back(vertex);
            if (i < 2 * rings && j < rings) {
                const auto k = static_cast<std::uint32_t>(j * (2 * rings + 1) + i), below = k + 2 * rings + 1;
                ball.indices.insert(ball.indices.end(), {k, below, below + 1, k, below + 1, k + 1});
            }
        }
    }
    for (const float thickness : stimuli::head::thickness_mm(ball)) {
        // Facets cut 0.03 mm off each side, and 48 directions sample the cone.
        ASSERT_NEAR(thickness, radius_mm / std::log(2.0F), 0.3F);
    }
}

TEST(HeadThicknessTest, isThinAtTheEars) {
    const std::vector<float> thickness = stimuli::head::thickness_mm(mesh());
    const auto thinnest_beyond = [&](float x) {
        float least = 1000;
        for (std::size_t i = 0; i < thickness.size(); ++i) {
            least = std::abs(mesh().vertices[i].position_mm.x) > x && mesh().vertices[i].position_mm.y > -60
                        ? std::min(least, thickness[i])
                        : least;
        }
        return least;
    };
    // An ear's rim is 2 to 5 mm thick; a skull is none of that.
    EXPECT_LT(thinnest_beyond(82), 5);
    float skull = 1000;
    for (std::size_t i = 0; i < thickness.size(); ++i) {
        skull = mesh().vertices[i].position_mm.y > 50 ? std::min(skull, thickness[i]) : skull;
    }
    EXPECT_GT(skull, 30);
}

TEST_F(HeadFileTest, isNotTakenFromABrokenCache) {
    const char* before = std::getenv("XDG_CACHE_HOME");
    const std::string kept_before = before ? before : "";
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    const auto absent = stimuli::head::read_cached({});
    stimuli::head::write_cached({}, head());
    const auto kept = stimuli::head::read_cached({});
    stimuli::HeadSettings settings;
    settings.age_years = 46;
    const auto older = stimuli::head::read_cached(settings);
    for (const auto& entry : fs::directory_iterator(folder / "skin2afc")) {
        std::string content = support::read_text(entry.path());
        content[content.size() / 2] = static_cast<char>(content[content.size() / 2] + 1);
        support::write_atomically(entry.path(), content);
    }
    const auto broken = stimuli::head::read_cached({});
    before ? ::setenv("XDG_CACHE_HOME", kept_before.c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
    EXPECT_FALSE(absent);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->digest, head().digest);
    EXPECT_FALSE(older) << "another's head";
    EXPECT_FALSE(broken);
}

TEST(HeadPersonTest, agesAndDarkens) {
    stimuli::HeadSettings settings;
    settings.seed = 3;
    settings.age_years = 75;
    settings.melanin = 0.27;
    const Model elder = stimuli::sculpt_head(settings);
    const auto mean = [](const renderer::scene::Image& image, auto value) {
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
            sum += value(&image.pixels[i]);
        }
        return sum / static_cast<double>(image.pixels.size()) * 3;
    };
    const auto red = [](const std::uint8_t* texel) { return static_cast<double>(texel[0]); };
    const auto slope2 = [](const std::uint8_t* texel) {
        return std::pow(texel[0] - 127.5, 2) + std::pow(texel[1] - 127.5, 2);
    };
    const auto &old_skin = elder.materials.front(), &skin = head().materials.front();
    EXPECT_LT(mean(*old_skin.base_color, red), 0.75 * mean(*skin.base_color, red));
    EXPECT_GT(mean(*old_skin.normal, slope2), 1.2 * mean(*skin.normal, slope2)) << "wrinkles";
    EXPECT_NE(elder.meshes.front().vertices[9000].position_mm, mesh().vertices[9000].position_mm);
    EXPECT_EQ(elder.meshes.front().indices, mesh().indices);
}

} // namespace
