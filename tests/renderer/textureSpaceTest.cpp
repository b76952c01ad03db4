// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <gtest/gtest.h>

#include <renderer/gl/context.h>
#include <renderer/passes/pipeline.h>
#include <stimuli/head.h>
#include <support/error.h>

#include "plane.h"
#include "uv_layout.h"

namespace passes = renderer::passes;
namespace scene = renderer::scene;
using passes::Frame;
using passes::Shader;

namespace {

class TextureSpaceTest : public testing::Test {
protected:
    static void SetUpTestSuite() { context.emplace(renderer::gl::Context::headless()); }
    static void TearDownTestSuite() { context.reset(); }

    static std::optional<renderer::gl::Context> context;
};
std::optional<renderer::gl::Context> TextureSpaceTest::context;

passes::Methods methods(bool culled, int map_size) {
    passes::Methods methods;
    methods.ts.culled = culled;
    methods.ts.map_size = map_size;
    return methods;
}

/// A light from the side and above, whose shadows' borders show how distant light spreads.
passes::Light side_light() {
    passes::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(1, 0.5f, 0.3f));
    light.shadow_map_size = 1024;
    return light;
}

int greatest_difference(const Frame& a, const Frame& b) {
    int greatest = 0;
    for (std::size_t i = 0; i < a.srgb.size(); ++i) {
        greatest = std::max(greatest, std::abs(static_cast<int>(a.srgb[i]) - static_cast<int>(b.srgb[i])));
    }
    return greatest;
}

/// Root mean square of the difference over what the model covers, of 255.
double rms_difference(const Frame& a, const Frame& b) {
    double sum = 0;
    int values = 0;
    for (std::size_t i = 0; i < a.srgb.size(); ++i) {
        const double d = static_cast<double>(a.srgb[i]) - static_cast<double>(b.srgb[i]);
        sum += d * d;
        values += a.linear[i / 3 * 4 + 3] > 0 ? 1 : 0;
    }
    return std::sqrt(sum / values);
}

void add(scene::Model& model, scene::Model other, const glm::vec3& place_mm) {
    for (scene::Mesh& mesh : other.meshes) {
        for (scene::Vertex& vertex : mesh.vertices) {
            vertex.position_mm += place_mm;
        }
        mesh.material += model.materials.size();
        model.meshes.push_back(mesh);
    }
    model.materials.insert(model.materials.end(), other.materials.begin(), other.materials.end());
}

} // namespace

// At the study's distances a map of 512 is too coarse to shrink, so that this is the culling alone.
TEST_F(TextureSpaceTest, theCulledFormKeepsWhatIsSeenOfTheHead) {
    const scene::Model head = stimuli::builtin_head();
    passes::Look look;
    look.profile = renderer::optics::profile("skin_6g_deon2007");
    look.samples = 1;
    passes::Pipeline whole(head, look, methods(false, 512));
    passes::Pipeline culled(head, look, methods(true, 512));
    long long texels = 0; // lit once for all cameras
    for (const float distance_mm : {28 * 232 / 27.0f, 50 * 232 / 27.0f, 230 * 232 / 27.0f}) {
        scene::Camera camera = scenes::camera(distance_mm, 400, 300);
        camera.eye_mm.x = 0.2f * distance_mm;
        const Frame a = whole.render(Shader::ts, camera, side_light(), true);
        const Frame b = culled.render(Shader::ts, camera, side_light(), true);
        EXPECT_LE(greatest_difference(a, b), 2) << distance_mm; // the bound that the format states
        texels += a.counts.contains("texels") ? a.counts.at("texels") : 0;
        EXPECT_EQ(b.counts.at("texels") + b.counts.at("texels skipped"), texels);
        EXPECT_GT(b.counts.at("texels skipped"), texels / 8)
            << distance_mm; // the back is a small part of its map
    }
}

// Half of the meridians of a sphere face the camera, and fewer from nearby, of a radius' cosine.
TEST_F(TextureSpaceTest, theBackHalfIsNotLit) {
    const scene::Model model = scenes::sphere(80);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), methods(true, 512));
    const Frame frame = pipeline.render(Shader::ts, scenes::camera(600, 200, 200), side_light());
    const auto lit = static_cast<double>(frame.counts.at("texels"));
    const auto skipped = static_cast<double>(frame.counts.at("texels skipped"));
    // Seen are acos(80 / 600) of 180 degrees of the equator, and less elsewhere; 7 mm beside it are 5 degrees
    // and a block of 8 texels 6 degrees.
    const double seen = std::acos(80 / 600.0) / std::acos(-1.0);
    EXPECT_LT(lit / (lit + skipped), seen + 4 * 6 / 180.0);
    EXPECT_GT(lit / (lit + skipped), 0.8 * seen);
}

// A texel of a plane is its side over the map's, a pixel the distance over the focal length: two texels
// to a pixel suffice.
TEST_F(TextureSpaceTest, mapsAreTwiceAsFineAsPixels) {
    const scene::Model model = scenes::plane(100);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), methods(true, 512));
    for (const float distance_mm : {60.0f, 430.0f, 460.0f, 900.0f, 9000.0f}) {
        const scene::Camera camera = scenes::camera(distance_mm, 200, 200);
        const Frame frame = pipeline.render(Shader::ts, camera, side_light());
        int expected = 512;
        while (expected > 64 &&
               100.0f / static_cast<float>(expected / 2) <= 0.5f * distance_mm / camera.focal_px()) {
            expected /= 2;
        }
        EXPECT_EQ(frame.counts.at("smallest map"), expected) << distance_mm;
    }
}

// Detail finer than a pixel does not show: a map that shrinks with the picture looks as the whole one does.
TEST_F(TextureSpaceTest, smallerMapsKeepThePicture) {
    const scene::Model model = scenes::sphere(80);
    passes::Pipeline whole(model, scenes::diffuse_look(), methods(false, 1024));
    passes::Pipeline culled(model, scenes::diffuse_look(), methods(true, 1024));
    for (const float distance_mm : {1500.0f, 3000.0f}) {
        const scene::Camera camera = scenes::camera(distance_mm, 300, 300);
        const Frame a = whole.render(Shader::ts, camera, side_light(), true);
        const Frame b = culled.render(Shader::ts, camera, side_light(), true);
        EXPECT_LT(b.counts.at("smallest map"), 1024);
        // The bound that the format states: half a pixel decides what lies in the shade.
        EXPECT_LT(rms_difference(a, b), 1) << distance_mm;
    }
}

TEST_F(TextureSpaceTest, theCulledFormDependsOnTheViewAlone) {
    const scene::Model model = scenes::sphere(80);
    const passes::Look look = scenes::diffuse_look();
    passes::Pipeline used(model, look, methods(true, 256));
    scene::Camera behind = scenes::camera(-400, 128, 96);
    scene::Camera beside = scenes::camera(400, 128, 96);
    beside.eye_mm = {300, 100, 250};
    const scene::Camera distant = scenes::camera(2000, 128, 96);
    for (const scene::Camera& other : {behind, distant, beside, distant, behind}) {
        passes::Pipeline fresh(model, look, methods(true, 256));
        EXPECT_EQ(used.render(Shader::ts, other, side_light(), true).linear,
                  fresh.render(Shader::ts, other, side_light(), true).linear);
    }
    EXPECT_EQ(used.costs().at("ts irradiance and blurs").runs, 5);
    used.render(Shader::ts, behind, side_light());
    EXPECT_EQ(used.costs().at("ts irradiance and blurs").runs, 5);
}

TEST_F(TextureSpaceTest, whatIsOutOfViewIsNotLit) {
    scene::Model model = scenes::sphere(80);
    add(model, scenes::sphere(80), {1000, 0, 0});
    const scene::Camera camera = scenes::camera(600, 200, 150);
    passes::Pipeline whole(model, scenes::diffuse_look(), methods(false, 256));
    passes::Pipeline culled(model, scenes::diffuse_look(), methods(true, 256));
    const Frame a = whole.render(Shader::ts, camera, side_light());
    const Frame b = culled.render(Shader::ts, camera, side_light());
    EXPECT_EQ(a.counts.at("maps"), 2);
    EXPECT_EQ(b.counts.at("maps"), 1);
    EXPECT_EQ(b.counts.at("maps skipped"), 1);
    EXPECT_LE(greatest_difference(a, b), 2);
}

TEST_F(TextureSpaceTest, copiesLieAlike) {
    scene::Model model = scenes::sphere(80);
    scene::Model turned = scenes::sphere(80);
    scenes::turn(turned, 0.7f);
    add(model, turned, {200, 30, -1000});
    add(model, scenes::sphere(81), {0, 0, 0});
    scene::Model mirrored = scenes::sphere(80);
    for (scene::Vertex& vertex : mirrored.meshes[0].vertices) {
        vertex.uv.x = 1 - vertex.uv.x;
    }
    add(model, mirrored, {0, 0, 0});
    const auto alike = [&](std::size_t material) {
        return passes::lie_alike(model, passes::uv_layout(model, 0), passes::uv_layout(model, material));
    };
    EXPECT_TRUE(alike(1));
    EXPECT_FALSE(alike(2)); // larger
    EXPECT_FALSE(alike(3)); // of other coordinates
}

TEST_F(TextureSpaceTest, copiesShareTheirChartsAndLookTheSame) {
    scene::Model copies = scenes::sphere(80);
    add(copies, scenes::sphere(80), {200, 0, 0});
    // The same surface, told by another order of corners.
    scene::Model others = copies;
    std::vector<std::uint32_t>& indices = others.meshes[1].indices;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        std::rotate(&indices[i], &indices[i] + 1, &indices[i] + 3);
    }
    const scene::Camera camera = scenes::camera(1500, 300, 150);
    passes::Pipeline shared(copies, scenes::diffuse_look(), methods(false, 256));
    passes::Pipeline apart(others, scenes::diffuse_look(), methods(false, 256));
    const Frame a = shared.render(Shader::ts, camera, side_light());
    const Frame b = apart.render(Shader::ts, camera, side_light());
    EXPECT_EQ(a.counts.at("uv layouts"), 1);
    EXPECT_EQ(b.counts.at("uv layouts"), 2);
    EXPECT_LE(greatest_difference(a, b), 1); // rounding of the stretch, to half floats
}

TEST_F(TextureSpaceTest, aScreenBeforeAHeadDoesNotScatter) {
    scene::Model model = scenes::sphere(80);
    add(model, scenes::plane(100), {-50, 0, 120}); // the left half
    model.materials[1].scatters = false;
    model.materials[1].double_sided = true;
    model.meshes[1].has_uv = false; // nor does it need coordinates
    const scene::Camera camera = scenes::camera(600, 200, 150);
    for (const bool culled : {false, true}) {
        passes::Pipeline pipeline(model, scenes::diffuse_look(), methods(culled, 256));
        const Frame plain = pipeline.render(Shader::no_sss, camera, side_light());
        const Frame blurred = pipeline.render(Shader::ts, camera, side_light());
        EXPECT_EQ(blurred.counts.at("maps"), 1);
        int on_screen = 0;
        for (int y = 45; y < 105; ++y) {
            for (int x = 25; x < 95; ++x) { // 100 mm are 89 pixels there
                const std::size_t at = 3 * (static_cast<std::size_t>(y) * 200 + static_cast<std::size_t>(x));
                ++on_screen;
                for (std::size_t c = at; c < at + 3; ++c) {
                    ASSERT_EQ(plain.srgb[c], blurred.srgb[c]) << x << ' ' << y;
                }
            }
        }
        EXPECT_GT(on_screen, 4000);
        EXPECT_NE(plain.srgb, blurred.srgb);
    }
}

TEST_F(TextureSpaceTest, theCulledFormNeedsCoordinatesWithAnAreaToo) {
    scene::Model bare = scenes::plane(40);
    bare.meshes[0].has_uv = false;
    scene::Model flat = scenes::plane(40);
    for (scene::Vertex& vertex : flat.meshes[0].vertices) {
        vertex.uv = {0.5f, 0.5f};
    }
    const scene::Camera camera = scenes::camera(150, 64, 48);
    for (const scene::Model& model : {bare, flat}) {
        passes::Pipeline pipeline(model, scenes::diffuse_look(), methods(true, 64));
        EXPECT_THROW(pipeline.prepare(Shader::ts, camera, scenes::frontal_light()), support::InputError);
        EXPECT_NO_THROW(pipeline.render(Shader::ss_full, camera, scenes::frontal_light()));
    }
}

// Triangles whose texture coordinates fall together have no texel; they keep their light, in all forms.
TEST_F(TextureSpaceTest, skinWithoutAPlaceInTheMapKeepsItsLight) {
    scene::Model model = scenes::plane(30);
    for (scene::Vertex& vertex : model.meshes[0].vertices) {
        vertex.position_mm.x -= 20;
        vertex.uv *= 0.4f;
    }
    scene::Mesh placeless = scenes::plane(30).meshes[0];
    for (scene::Vertex& vertex : placeless.vertices) {
        vertex.position_mm.x += 20;
        vertex.uv = {0.9f, 0.9f};
    }
    model.meshes.push_back(placeless);
    const scene::Camera camera = scenes::camera(300, 120, 60);
    passes::Look look = scenes::diffuse_look();
    look.profile = renderer::optics::profile("skin_6g_deon2007");
    for (const bool culled : {false, true}) {
        for (const bool unblurred_first : {false, true}) {
            passes::Methods how = methods(culled, 64);
            how.ts.unblurred_first = unblurred_first;
            passes::Pipeline pipeline(model, look, how);
            const Frame frame = pipeline.render(Shader::ts, camera, scenes::frontal_light(), true);
            for (const int x : {48, 72}) { // on the square with a map, on that without
                const glm::vec4 found = scenes::value(frame, x, 30);
                EXPECT_EQ(found.a, 1) << x;
                for (glm::length_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(found[c], 1, 1.0f / 1024) << culled << unblurred_first << ' ' << x;
                }
            }
        }
    }
}
