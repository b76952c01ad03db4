// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <optional>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <renderer/gl/context.h>
#include <renderer/passes/pipeline.h>

#include "plane.h"

namespace passes = renderer::passes;
namespace scene = renderer::scene;
using passes::Shader;

namespace {

// The study's zoom and near: 28 and 50 of 27 units in 232 mm, and pixels per millimetre as with 988 lines at
// 20 degrees.
constexpr float zoom_mm = 28 * 232 / 27.0f, near_mm = 50 * 232 / 27.0f;
constexpr int width = 640, height = 400;

class ScreenSpaceTest : public testing::Test {
protected:
    static void SetUpTestSuite() { context.emplace(renderer::gl::Context::headless()); }
    static void TearDownTestSuite() { context.reset(); }

    static std::optional<renderer::gl::Context> context;
};
std::optional<renderer::gl::Context> ScreenSpaceTest::context;

scene::Camera study_camera(float distance_mm) {
    scene::Camera camera = scenes::camera(distance_mm, width, height);
    camera.fov_rad = 2 * std::atan(std::tan(glm::radians(10.0f)) * height / 988);
    return camera;
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Root mean square error of a shader over the middle rows of a half-white plane, as a share of the lit
/// level, within 6 mm of the edge. The plane is tilted about an axis in the image plane, `axis_deg` from x.
double half_plane_error(Shader shader, const passes::Methods& methods, float distance_mm, float tilt_deg,
                        float axis_deg) {
    scene::Model model = scenes::half_white_plane(60);
    const float axis = glm::radians(axis_deg);
    const glm::mat3 turn(
        glm::rotate(glm::mat4(1), glm::radians(tilt_deg), glm::vec3(std::cos(axis), std::sin(axis), 0)));
    for (scene::Vertex& v : model.meshes[0].vertices) {
        v.position_mm = turn * v.position_mm;
        v.normal = turn * v.normal;
        v.tangent = glm::vec4(turn * glm::vec3(v.tangent), v.tangent.w);
    }
    const passes::Look look = scenes::diffuse_look();
    passes::Pipeline pipeline(model, look, methods);
    const scene::Camera camera = study_camera(distance_mm);
    passes::Light light = scenes::frontal_light();
    light.irradiance /= std::cos(glm::radians(tilt_deg));
    const passes::Frame frame = pipeline.render(shader, camera, light, true);

    const glm::dvec3 normal(turn[2]);
    const glm::dvec3 across(turn[0]);
    const glm::dvec3 eye(camera.eye_mm);
    // Where the ray through a point of the image meets the plane.
    const auto place = [&](double x, double y) {
        const glm::dvec3 ray(x - 0.5 * width, 0.5 * height - y, -static_cast<double>(camera.focal_px()));
        return eye - ray * (glm::dot(normal, eye) / glm::dot(normal, ray));
    };
    double sum = 0;
    int count = 0;
    for (int y = height / 2 - 40; y < height / 2 + 40; ++y) {
        for (int x = 0; x < width; ++x) {
            const double from_edge_mm = glm::dot(place(x + 0.5, y + 0.5), across);
            if (std::abs(from_edge_mm) < 6 && glm::length(place(x + 0.5, y + 0.5)) < 20) {
                glm::dvec3 truth{0}; // the mean over the pixel
                for (int i = 0; i < 16; ++i) {
                    const double there_mm =
                        glm::dot(place(x + (i % 4 + 0.5) / 4, y + (i / 4 + 0.5) / 4), across);
                    for (const auto& g : look.profile.gaussians) {
                        truth += g.weight * normal_cdf(-there_mm / std::sqrt(g.variance_mm2)) / 16.0;
                    }
                }
                const glm::dvec3 error = glm::dvec3(scenes::value(frame, x, y)) - truth;
                sum += glm::dot(error, error) / 3;
                ++count;
            }
        }
    }
    EXPECT_GT(count, 2000);
    return std::sqrt(sum / count);
}

/// A lit square hovering before a dark plane: light on the plane beside the square's edge has leaked across
/// the gap. Gives the mean of red over the 4 mm beside it, as a share of the square's light; none of it
/// should be there, but for what the profile carries over 20 mm (below 1e-6).
double halo(const passes::Methods& methods) {
    scene::Model model = scenes::plane(120);
    model.materials[0].base_color_factor = glm::vec3(0);
    scene::Model square = scenes::plane(30);
    for (scene::Vertex& vertex : square.meshes[0].vertices) {
        vertex.position_mm.z = 20;
    }
    square.meshes[0].material = 1;
    model.materials.push_back(square.materials[0]);
    model.meshes.push_back(square.meshes[0]);
    passes::Pipeline pipeline(model, scenes::diffuse_look(), methods);
    const scene::Camera camera = study_camera(near_mm);
    const passes::Frame frame = pipeline.render(Shader::ss_full, camera, scenes::frontal_light(), true);
    const double edge_px = 15 * static_cast<double>(camera.focal_px() / (near_mm - 20));
    const double end_px = edge_px + 4 * static_cast<double>(camera.focal_px() / near_mm);
    double sum = 0;
    int count = 0;
    for (int x = width / 2 + static_cast<int>(std::ceil(edge_px)) + 1; x + 1 - width / 2 < end_px; ++x) {
        sum += static_cast<double>(scenes::value(frame, x, height / 2).r);
        ++count;
    }
    EXPECT_GT(count, 10);
    EXPECT_NEAR(scenes::value(frame, width / 2, height / 2).r, 1, 0.02f);
    return sum / count;
}

passes::Methods published() {
    passes::Methods methods;
    methods.full = passes::published_full();
    methods.ts.unblurred_first = true;
    return methods;
}

} // namespace

// The truth is a sum of error functions; the bound is the project's goal, without scattering the error is 7
// %.
TEST_F(ScreenSpaceTest, bothGaussianMethodsReachTheClosedFormOnAFacingPlane) {
    for (const float distance_mm : {zoom_mm, near_mm}) {
        EXPECT_LT(half_plane_error(Shader::ts, {}, distance_mm, 0, 0), 0.005) << distance_mm;
        EXPECT_LT(half_plane_error(Shader::ss_full, {}, distance_mm, 0, 0), 0.005) << distance_mm;
    }
}

// Along the tilt, across it, and slanted: the surface's metric is right for all; the published form is not.
TEST_F(ScreenSpaceTest, exactForeshorteningIsRightForPlanesOfAnyTilt) {
    for (const float axis_deg : {0.0f, 45.0f, 70.0f, 90.0f}) {
        EXPECT_LT(half_plane_error(Shader::ss_full, {}, zoom_mm, 60, axis_deg), 0.006) << axis_deg;
    }
    EXPECT_GT(half_plane_error(Shader::ss_full, published(), zoom_mm, 60, 90), 0.009);
}

// What the papers print: 4 % too wide in the plane, and the narrowest Gaussian of ts not blurred at all.
TEST_F(ScreenSpaceTest, publishedFormsKeepTheirErrors) {
    EXPECT_GT(half_plane_error(Shader::ss_full, published(), near_mm, 0, 0), 0.004);
    EXPECT_GT(half_plane_error(Shader::ts, published(), zoom_mm, 0, 0), 0.009);
}

TEST_F(ScreenSpaceTest, everySettingStaysNearTheClosedForm) {
    for (const int taps : {7, 9, 13, 25}) {
        passes::Methods methods;
        methods.full.taps = taps;
        EXPECT_LT(half_plane_error(Shader::ss_full, methods, near_mm, 30, 90), 0.005) << taps;
    }
    for (const int bits : {8, 16, 32}) {
        passes::Methods methods;
        methods.full.target_bits = bits;
        EXPECT_LT(half_plane_error(Shader::ss_full, methods, near_mm, 0, 0), 0.006) << bits;
    }
    passes::Methods whole;
    whole.full.half_resolution = false;
    EXPECT_LT(half_plane_error(Shader::ss_full, whole, zoom_mm, 30, 45), 0.005);
    // Few taps in one pass are coarser; more of them are better.
    passes::Methods jittered;
    const double thirteen = half_plane_error(Shader::ss_jittered, jittered, zoom_mm, 0, 0);
    jittered.jittered.taps = 49;
    EXPECT_LT(half_plane_error(Shader::ss_jittered, jittered, zoom_mm, 0, 0), thirteen);
    EXPECT_LT(thirteen, 0.035);
}

// The papers' own limitation [JimenezGutierrez2010, Figure 7.7].
TEST_F(ScreenSpaceTest, lightDoesNotLeakAcrossDepthGaps) {
    const double improved = halo({});
    const double as_published = halo(published());
    EXPECT_GT(as_published, 0.05);
    EXPECT_LT(improved, 0.02 * as_published) << improved << ' ' << as_published;
    passes::Methods whole;
    whole.full.half_resolution = false;
    EXPECT_LT(halo(whole), 0.02 * as_published) << as_published;
    RecordProperty("halo_published", std::to_string(as_published));
    RecordProperty("halo_improved", std::to_string(improved));
}
