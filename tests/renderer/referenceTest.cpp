// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <renderer/optics/specular.h>
#include <renderer/reference/reference.h>
#include <support/error.h>

#include "plane.h"

namespace optics = renderer::optics;
namespace reference = renderer::reference;
namespace scene = renderer::scene;

namespace {

scene::Look look_with(double sigma_mm) {
    scene::Look look = scenes::diffuse_look();
    look.profile.gaussians = {{sigma_mm * sigma_mm, glm::dvec3(1)}};
    return look;
}

scene::Frame rendered(const scene::Model& model, const scene::Look& look, const scene::Camera& camera,
                      const scene::Light& light) {
    return reference::Reference(model, look).render(camera, light, true);
}

} // namespace

TEST(ReferenceTest, aBlockerCastsItsShadowAtTheRightPlace) {
    scene::Model model = scenes::plane(100);
    scene::Model blocker = scenes::plane(20);
    for (scene::Vertex& vertex : blocker.meshes[0].vertices) {
        vertex.position_mm.z = 30;
    }
    model.meshes.push_back(blocker.meshes[0]);
    scene::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(1, 0, 1)); // the shadow falls 30 mm to -x
    light.irradiance *= std::sqrt(2.0f);
    const scene::Camera camera = scenes::camera(600, 300, 200);
    const scene::Frame frame = rendered(model, look_with(0), camera, light);
    const auto at = [&](float x_mm) {
        const int x = static_cast<int>(std::floor(150 + x_mm / 600 * camera.focal_px()));
        return scenes::value(frame, x, 100).g;
    };
    EXPECT_EQ(at(-30), 0);
    EXPECT_EQ(at(-39.0f), 0); // two pixels from the edge
    EXPECT_NEAR(at(-41.0f), 1, 1e-5f);
    EXPECT_EQ(at(-21.0f), 0);
    EXPECT_NEAR(at(-19.0f), 1, 1e-5f);
}

// A sphere without scattering is N.L: neither acne nor facets where the light turns away.
TEST(ReferenceTest, aSphereIsSmoothUpToTheTerminator) {
    scene::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(1, 0.3f, 0.2f));
    const scene::Camera camera = scenes::camera(900, 320, 240);
    const scene::Frame frame = rendered(scenes::sphere(80), look_with(0), camera, light);
    int seen = 0;
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) {
            const glm::dvec3 ray = glm::normalize(
                glm::dvec3(x + 0.5 - 160, 120 - y - 0.5, -static_cast<double>(camera.focal_px())));
            const glm::dvec3 eye(camera.eye_mm);
            const double b = glm::dot(ray, eye);
            const double root = b * b - (900.0 * 900 - 80 * 80);
            if (root < 30 * 30) { // beside the limb a pixel covers many normals
                continue;
            }
            const glm::dvec3 n = (eye + ray * (-b - std::sqrt(root))) / 80.0;
            const double NoL = glm::dot(n, glm::dvec3(light.direction));
            const auto found = static_cast<double>(scenes::value(frame, x, y).g);
            ++seen;
            EXPECT_NEAR(found, std::max(NoL, 0.0), 0.006) << x << ' ' << y << ' ' << NoL; // half a pixel
        }
    }
    EXPECT_GT(seen, 9000);
}

// Facets of 11 degrees, whose normals turn smoothly: those that face away from the light where the smooth
// surface does not yet are not to be dark.
TEST(ReferenceTest, facetsDoNotShadeThemselves) {
    scene::Model model = scenes::sphere(80);
    scene::Mesh& mesh = model.meshes[0];
    mesh.indices.clear();
    constexpr std::uint32_t columns = 256, step = 8; // of scenes::sphere, 257 vertices a row
    for (std::uint32_t j = 0; j < 128; j += step) {
        for (std::uint32_t i = 0; i < columns; i += step) {
            const std::uint32_t a = j * (columns + 1) + i;
            const std::uint32_t b = a + step * (columns + 1);
            mesh.indices.insert(mesh.indices.end(), {a, b, b + step, a, b + step, a + step});
        }
    }
    scene::Light light = scenes::frontal_light();
    light.direction = {1, 0, 0};
    const scene::Camera camera = scenes::camera(900, 240, 240);
    const scene::Frame frame = rendered(model, look_with(0), camera, light);
    for (int x = 122; x < 150; ++x) { // right of the middle, where the surface turns towards the light
        const double ray = (x + 0.5 - 120) / static_cast<double>(camera.focal_px());
        double NoL = 0;
        for (int i = 0; i < 5; ++i) { // where the ray meets the sphere, by iteration
            NoL = ray * (900 - 80 * std::sqrt(1 - NoL * NoL)) / 80;
        }
        for (int y = 110; y < 130; ++y) {
            // Within a facet normals bend, and places lie, up to a hundredth beside the sphere's.
            EXPECT_NEAR(static_cast<double>(scenes::value(frame, x, y).g), NoL, 0.01) << x;
        }
    }
}

// At normal incidence, seen from the light: h = 2N, so the lobe is F0 / (4 m^2), and what is reflected is
// missing from the diffuse light on the way in and on the way out.
TEST(ReferenceTest, reflectsAsKelemenAndSzirmayKalosAtNormalIncidence) {
    scene::Look look = look_with(0);
    look.specular_intensity = 0.18f;
    const scene::Camera camera = scenes::camera(500, 33, 33);
    const scene::Frame frame = rendered(scenes::plane(400), look, camera, scenes::frontal_light());
    const double transmitted = 1 - 0.18 * optics::specular_albedo(1, 0.3, 0.028);
    const double expected = transmitted * transmitted + 0.18 * 0.028 / (4 * 0.3 * 0.3);
    EXPECT_NEAR(static_cast<double>(scenes::value(frame, 16, 16).g), expected, 1e-4); // the pixel's cone
}

TEST(ReferenceTest, splitsTheColourAroundScattering) {
    scene::Model model = scenes::plane(100);
    model.materials[0].base_color_factor = {0.5f, 0.25f, 0.04f};
    scene::Look look = scenes::diffuse_look();
    for (const float mix : {0.0f, 0.5f, 0.7f, 1.0f}) {
        look.texture_mix = mix;
        const scene::Frame frame = rendered(model, look, scenes::camera(60, 16, 16), scenes::frontal_light());
        EXPECT_NEAR(scenes::value(frame, 8, 8).r, 0.5f, 1e-3f) << mix;
        EXPECT_NEAR(scenes::value(frame, 8, 8).b, 0.04f, 1e-4f) << mix;
    }
}

TEST(ReferenceTest, givesTheSameBytesWhateverTheThreads) {
    scene::Light light = scenes::frontal_light();
    light.direction = glm::normalize(glm::vec3(1, 0.5f, 0.2f));
    scene::Look look = scenes::diffuse_look();
    look.bloom_strength = 0.1f;
    const scene::Camera camera = scenes::camera(150, 90, 61);
    const scene::Model model = scenes::sphere(20);
    const scene::Frame many = rendered(model, look, camera, light);
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    const scene::Frame one = rendered(model, look, camera, light);
    EXPECT_EQ(many.linear, one.linear);
    EXPECT_EQ(many.srgb, one.srgb);
}

TEST(ReferenceTest, placeInTheWorldChangesNothing) {
    const glm::vec3 far_mm(1 << 20, -(1 << 19), 1 << 20); // floats keep sixteenths of a millimetre there
    scene::Model model = scenes::plane(64);
    const scene::Look look = scenes::diffuse_look();
    scene::Camera camera = scenes::camera(100, 40, 30);
    const scene::Frame near = rendered(model, look, camera, scenes::frontal_light());
    for (scene::Vertex& vertex : model.meshes[0].vertices) {
        vertex.position_mm += far_mm;
    }
    camera.eye_mm += far_mm;
    camera.target_mm += far_mm;
    EXPECT_EQ(near.linear, rendered(model, look, camera, scenes::frontal_light()).linear);
}

TEST(ReferenceTest, bloomKeepsTheTotalLight) {
    const scene::Model model = scenes::plane(10);
    scene::Look look = scenes::diffuse_look();
    const scene::Camera camera = scenes::camera(200, 127, 95);
    const scene::Frame without = rendered(model, look, camera, scenes::frontal_light());
    look.bloom_strength = 0.3f;
    look.bloom_sigma_px = 4;
    const scene::Frame with = rendered(model, look, camera, scenes::frontal_light());
    double sums[2] = {0, 0};
    for (std::size_t i = 0; i < with.linear.size(); i += 4) {
        sums[0] += static_cast<double>(without.linear[i]);
        sums[1] += static_cast<double>(with.linear[i]);
    }
    EXPECT_NEAR(sums[1] / sums[0], 1, 0.02); // at odd sizes halving and doubling weigh pixels unevenly
    EXPECT_NE(with.srgb, without.srgb);
}

TEST(ReferenceTest, everyValueIsFiniteForBrokenModels) {
    scene::Model model = scenes::plane(30);
    scene::Mesh& mesh = model.meshes[0];
    mesh.has_uv = false;
    for (scene::Vertex& vertex : mesh.vertices) {
        vertex.uv = glm::vec2(0);
        vertex.tangent = glm::vec4(0);
    }
    mesh.vertices[0].normal = glm::vec3(0);
    mesh.vertices[1].normal = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    mesh.vertices[2].uv = glm::vec2(1e30f, std::numeric_limits<float>::infinity());
    mesh.indices.insert(mesh.indices.end(), {0, 0, 0, 0, 1, 1, 0, 2, 0}); // without area
    scene::Look look = scenes::diffuse_look();
    look.specular_intensity = 0.18f;
    for (const glm::vec3 eye :
         {glm::vec3(0, 0, 50), glm::vec3(0, 0, 1e-3f), glm::vec3(0, 0, -5), glm::vec3(0)}) {
        scene::Camera camera = scenes::camera(1, 21, 15);
        camera.eye_mm = eye;
        camera.target_mm = eye - glm::vec3(0, 0, 1);
        for (const float v : rendered(model, look, camera, scenes::frontal_light()).linear) {
            ASSERT_TRUE(std::isfinite(v));
        }
    }
}

TEST(ReferenceTest, passesThroughBackFacesOfSingleSidedMaterialsAlone) {
    scene::Model model = scenes::plane(30);
    scene::Camera camera = scenes::camera(50, 9, 9);
    camera.eye_mm.z = -50;
    EXPECT_EQ(scenes::value(rendered(model, look_with(0), camera, scenes::frontal_light()), 4, 4).a, 0);
    model.materials[0].double_sided = true;
    const glm::vec4 behind =
        scenes::value(rendered(model, look_with(0), camera, scenes::frontal_light()), 4, 4);
    EXPECT_EQ(behind, glm::vec4(0, 0, 0, 1)); // seen, and turned away from the light
}

// Each pixel of this view wants dozens of cells, some 4 million. A tenth of that gives larger cells; a
// thousandth would show them.
TEST(ReferenceTest, refusesAViewThatNeedsFarMoreCellsThanItMayHave) {
    const scene::Model model = scenes::plane(100);
    const scene::Camera camera = scenes::camera(200, 300, 300);
    const scene::Look look = look_with(0.2 * 200 / static_cast<double>(camera.focal_px()));
    const auto most = [&](std::size_t cells) {
        reference::Reference(model, look, {.samples_per_side = 1, .most_cells = cells})
            .render(camera, scenes::frontal_light());
    };
    EXPECT_NO_THROW(most(400'000));
    EXPECT_THROW(most(4'000), support::InputError);
}

TEST(ReferenceTest, refusesWhatHasNoPicture) {
    const scene::Model model = scenes::plane(30);
    const scene::Look look = scenes::diffuse_look();
    EXPECT_THROW(reference::Reference(model, look, {.samples_per_side = 0}), support::InputError);
    EXPECT_THROW(reference::Reference(model, look, {.cells_per_sigma = std::nan("")}), support::InputError);
    EXPECT_THROW(reference::Reference(scene::Model{}, look), support::InputError);
    EXPECT_THROW(reference::Reference(model, look_with(std::nan(""))), support::InputError);
    reference::Reference renderer(model, look);
    scene::Light dark = scenes::frontal_light();
    dark.direction = glm::vec3(0);
    EXPECT_THROW(renderer.render(scenes::camera(50, 9, 9), dark), support::InputError);
    EXPECT_THROW(renderer.render(scenes::camera(50, 0, 9), scenes::frontal_light()), support::InputError);
}
