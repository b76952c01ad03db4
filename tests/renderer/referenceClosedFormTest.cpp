// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <renderer/optics/profile.h>
#include <renderer/reference/reference.h>

#include "plane.h"

namespace optics = renderer::optics;
namespace reference = renderer::reference;
namespace scene = renderer::scene;

namespace {

/// A square with one corner at `low` and the opposite at `high`, in the plane z = 0, added to a model with a
/// colour of its own.
void add_rectangle(scene::Model& model, const glm::vec2& low, const glm::vec2& high, float color) {
    scene::Mesh mesh = scenes::plane(1).meshes[0];
    for (scene::Vertex& vertex : mesh.vertices) {
        const glm::vec2 place = glm::mix(low, high, glm::vec2(vertex.position_mm) + 0.5f);
        vertex.position_mm = glm::vec3(place, 0);
    }
    mesh.material = model.materials.size();
    model.materials.emplace_back().base_color_factor = glm::vec3(color);
    model.meshes.push_back(mesh);
}

/// A plane that reflects where x < 0 alone, so that it is as if lit there alone.
scene::Model half_plane(float side_mm) {
    const float h = side_mm / 2;
    scene::Model model;
    model.name = "half plane";
    add_rectangle(model, {-h, -h}, {0, h}, 1);
    add_rectangle(model, {0, -h}, {h, h}, 0);
    return model;
}

scene::Look look_with(double sigma_mm) {
    scene::Look look = scenes::diffuse_look();
    look.profile.gaussians = {{sigma_mm * sigma_mm, glm::dvec3(1)}};
    return look;
}

scene::Frame rendered(const scene::Model& model, const scene::Look& look, const scene::Camera& camera,
                      const scene::Light& light) {
    return reference::Reference(model, look).render(camera, light, true);
}

/// The closed form beside the edge of a lit half plane: a sum of error functions.
glm::dvec3 beside_edge(const optics::Profile& profile, double x_mm) {
    glm::dvec3 sum{0};
    for (const optics::Gaussian& g : profile.gaussians) {
        sum += g.weight * (0.5 * std::erfc(x_mm / std::sqrt(2 * g.variance_mm2)));
    }
    return sum;
}

/// Root mean square difference between the half plane, turned by an angle, and its closed form.
double edge_error(double angle_rad, float distance_mm) {
    scene::Model model = half_plane(2000);
    scenes::turn(model, static_cast<float>(angle_rad));
    scene::Light light = scenes::frontal_light();
    light.direction = glm::normalize(
        glm::vec3(static_cast<float>(std::sin(angle_rad)), 0, static_cast<float>(std::cos(angle_rad))));
    const scene::Camera camera = scenes::camera(distance_mm, 160, 120);
    const scene::Look look = scenes::diffuse_look();
    const scene::Frame frame = rendered(model, look, camera, light);
    const auto focal_px = static_cast<double>(camera.focal_px());
    double squares = 0;
    for (int x = 0; x < frame.width; ++x) {
        // The mean over the pixel of what its rays meet: u along the plane, where they cross it.
        glm::dvec3 expected{0};
        constexpr int steps = 64;
        for (int i = 0; i < steps; ++i) {
            const double X = x + (i + 0.5) / steps - 0.5 * frame.width;
            const double u = static_cast<double>(distance_mm) * X /
                             (std::cos(angle_rad) * focal_px - std::sin(angle_rad) * X);
            expected += beside_edge(look.profile, u) / static_cast<double>(steps);
        }
        const glm::dvec3 found(scenes::value(frame, x, 60));
        squares += glm::dot(found - expected, found - expected) / 3;
    }
    return std::sqrt(squares / frame.width);
}

} // namespace

// Pixels of 0.06 and 0.3 mm, as at the zoom and far distances of a head.
TEST(ReferenceClosedFormTest, followsTheClosedFormBesideAnEdge) {
    for (const double angle_deg : {0.0, 30.0, 60.0}) {
        const double angle = angle_deg * std::numbers::pi / 180;
        EXPECT_LT(edge_error(angle, 20), 0.002) << angle_deg; // the promise of the ground truth
        EXPECT_LT(edge_error(angle, 100), 0.002) << angle_deg;
    }
}

// Pixels of 3 mm, and a Gaussian of an eighth of that: it is sampled with the 16 rays of a pixel, and the
// mean over the rows tells how well.
TEST(ReferenceClosedFormTest, followsTheClosedFormWherePixelsAreWide) {
    const scene::Look look = look_with(0.36);
    const scene::Camera camera = scenes::camera(1000, 16, 120);
    const scene::Frame frame = rendered(half_plane(2000), look, camera, scenes::frontal_light());
    const double px_mm = 1000 / static_cast<double>(camera.focal_px());
    for (int x = 6; x < 10; ++x) { // the edge lies between pixels 7 and 8
        double found = 0;
        double expected = 0;
        for (int i = 0; i < 120; ++i) {
            found += static_cast<double>(scenes::value(frame, x, i).g) / 120;
            expected += beside_edge(look.profile, (x - 8 + (i + 0.5) / 120) * px_mm).g / 120;
        }
        // One of 1920 samples is worth 5e-4; a few of those near the edge fall on the wrong side.
        EXPECT_NEAR(found, expected, 0.004) << x;
    }
}

TEST(ReferenceClosedFormTest, aPointOfLightSpreadsAsTheProfile) {
    constexpr float side_mm = 0.02f;
    scene::Model model;
    const float a = side_mm / 2;
    add_rectangle(model, {-a, -a}, {a, a}, 1);
    add_rectangle(model, {-20, -20}, {-a, 20}, 0);
    add_rectangle(model, {a, -20}, {20, 20}, 0);
    add_rectangle(model, {-a, -20}, {a, -a}, 0);
    add_rectangle(model, {-a, a}, {a, 20}, 0);
    const scene::Look look = scenes::diffuse_look();
    const scene::Camera camera = scenes::camera(5, 129, 33); // pixels of 0.05 mm
    const scene::Frame frame = rendered(model, look, camera, scenes::frontal_light());
    const double px_mm = 5 / static_cast<double>(camera.focal_px());
    for (int x = 0; x < frame.width; ++x) {
        const double r = (x - 64) * px_mm;
        const glm::dvec3 expected =
            optics::diffuse_reflectance(look.profile, r) * static_cast<double>(side_mm * side_mm);
        const glm::dvec3 found(scenes::value(frame, x, 16));
        // A pixel is up to .66 standard deviations wide, and its mean .66^2 / 12 below the peak.
        EXPECT_NEAR(found.r / expected.r, 1, 0.04) << r;
        if (std::abs(r) > 0.3) {
            EXPECT_NEAR(found.r / expected.r, 1, 0.005) << r;
        }
    }
}

// Light from above and its mirror image from below add up to 1 everywhere. On a sphere the area within the
// chord r of a point is pi r^2, so a Gaussian's share is 1 - exp(-(2 radius)^2 / 2v).
TEST(ReferenceClosedFormTest, aUniformlyLitSphereStaysUniform) {
    for (const float radius_mm : {3.0f, 20.0f}) {
        const scene::Look look = scenes::diffuse_look();
        scene::Light light = scenes::frontal_light();
        light.ambient_irradiance = light.irradiance;
        light.irradiance = glm::vec3(0);
        const scene::Camera camera = scenes::camera(8 * radius_mm, 60, 60);
        const scene::Frame frame = rendered(scenes::sphere(radius_mm), look, camera, light);
        glm::dvec3 expected{0};
        const double diameter = 2 * static_cast<double>(radius_mm);
        for (const optics::Gaussian& g : look.profile.gaussians) {
            expected += g.weight * (1 - std::exp(-diameter * diameter / (2 * g.variance_mm2)));
        }
        int seen = 0;
        for (int y = 0; y < 60; ++y) {
            for (int x = 0; x < 60; ++x) {
                const glm::vec4 above = scenes::value(frame, x, y);
                const glm::vec4 below = scenes::value(frame, x, 59 - y);
                if (above.a == 1 && below.a == 1) {
                    ++seen;
                    const glm::dvec3 sum(above + below);
                    EXPECT_NEAR(sum.r, expected.r, 0.002) << x << ' ' << y; // the facets' area and chords
                    EXPECT_NEAR(sum.b, expected.b, 0.002) << x << ' ' << y;
                }
            }
        }
        EXPECT_GT(seen, 1000);
    }
}

TEST(ReferenceClosedFormTest, aUniformlyLitPlaneKeepsItsEnergy) {
    for (const float distance_mm : {8.0f, 40.0f, 150.0f, 800.0f}) {
        const scene::Frame frame = rendered(scenes::plane(600), scenes::diffuse_look(),
                                            scenes::camera(distance_mm, 48, 48), scenes::frontal_light());
        for (int i = 0; i < 48; ++i) {
            const glm::vec4 value = scenes::value(frame, i, i);
            EXPECT_NEAR(value.r, 1, 5e-4f) << distance_mm; // cells that are not squares, and the reach
            EXPECT_NEAR(value.b, 1, 5e-4f) << distance_mm;
            EXPECT_EQ(value.a, 1);
        }
    }
}
