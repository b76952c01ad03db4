// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/scenes.h>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <renderer/reference/reference.h>
#include <support/error.h>

namespace {

using measure::ClosedForm;
namespace scene = renderer::scene;

renderer::optics::Profile skin() { return renderer::optics::profile("skin_6g_deon2007"); }
// Pixels of 0.26 mm on a facing plane.
const scene::Camera camera = measure::frontal_camera(240, 20, 480, 320);

glm::dvec3 truth(const ClosedForm& form, double x_px, double y_px) {
    const auto value = form.truth(camera, x_px, y_px);
    EXPECT_TRUE(value) << form.name << ' ' << x_px << ' ' << y_px;
    return value.value_or(glm::dvec3(-1));
}

/// Light at the distance from an edge: the lit half plane as a sum of strips of the profile's line spread,
/// each strip a sum over its length.
glm::dvec3 naive_half_plane(double x_mm) {
    const renderer::optics::Profile profile = skin();
    constexpr double step = 0.02, reach = 12;
    glm::dvec3 sum(0);
    for (double x = -reach + step / 2; x < 0; x += step) {
        for (double y = -reach + step / 2; y < reach; y += step) {
            sum += step * step *
                   glm::dvec3(renderer::optics::diffuse_reflectance(profile, std::hypot(x - x_mm, y)));
        }
    }
    return sum;
}

/// A frame that shows the truth of each pixel's middle, with a constant added.
scene::Frame frame_of(const ClosedForm& form, float error) {
    scene::Frame frame;
    frame.width = camera.width;
    frame.height = camera.height;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const glm::vec3 value(form.truth(camera, x + 0.5, y + 0.5).value_or(glm::dvec3(0)));
            for (int c = 0; c < 3; ++c) {
                frame.linear.push_back(value[c] + error * static_cast<float>(form.level[c]));
            }
            frame.linear.push_back(1);
        }
    }
    return frame;
}

} // namespace

// The naive sum misses 0.3 % of the light beyond 12 mm and in the narrowest Gaussian's bend, 0.08 mm for a
// step of 0.02.
TEST(ScenesTest, halfPlaneIsTheProfileSummedOverTheLitHalf) {
    const ClosedForm form = measure::half_lit_plane(skin(), 0);
    const double px_per_mm = static_cast<double>(camera.focal_px()) / 240;
    for (const double x_mm : {-3.0, -0.5, 0.5, 2.0}) {
        const glm::dvec3 expected = naive_half_plane(x_mm);
        const glm::dvec3 found = truth(form, 240 + x_mm * px_per_mm, 160);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], expected[c], 0.004) << x_mm << ' ' << c;
        }
    }
}

// Half of the light at the edge, by symmetry, at every tilt; all or none of the green and blue far from it.
TEST(ScenesTest, halfPlanesAreSymmetric) {
    for (const double tilt_deg : {0.0, 30.0, 60.0}) {
        const ClosedForm form = measure::half_lit_plane(skin(), tilt_deg);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(truth(form, 240, 160)[c], 0.5, 1e-3)
                << tilt_deg; // the profile's weights sum to 1 within 1e-3
        }
        const double reach_px =
            5 * std::cos(glm::radians(tilt_deg)) * static_cast<double>(camera.focal_px()) / 240;
        EXPECT_NEAR(truth(form, 240 - reach_px, 160).b, 1, 2e-3);
        EXPECT_NEAR(truth(form, 240 + reach_px, 160).b, 0, 2e-3);
    }
}

// Light that leaves around the dot, seen whole, is what entered it: 1 mm^2, less red beyond 3 mm.
TEST(ScenesTest, dotKeepsItsEnergy) {
    const ClosedForm form = measure::lit_dot(skin());
    const scene::Camera fine = measure::frontal_camera(60, 20, 480, 320); // pixels of 0.07 mm
    const double mm_per_px = 60 / static_cast<double>(fine.focal_px());
    glm::dvec3 sum(0);
    for (int y = 0; y < 320; ++y) {
        for (int x = 0; x < 480; ++x) {
            sum += form.truth(fine, x + 0.5, y + 0.5).value_or(glm::dvec3(0)) * mm_per_px * mm_per_px;
        }
    }
    EXPECT_NEAR(sum.b, 1, 0.01);
    EXPECT_NEAR(sum.g, 1, 0.03);
    EXPECT_GT(sum.r, 0.8);
    EXPECT_LT(sum.r, 1);
}

// The mean over a pixel differs from its middle by the light's curvature: 0.2 % where the narrowest Gaussian
// bends.
TEST(ScenesTest, errorIsAShareOfTheLitLevel) {
    for (const ClosedForm& form : measure::closed_forms(skin())) {
        EXPECT_LT(measure::closed_form_error(form, camera, frame_of(form, 0)), 0.015) << form.name;
        EXPECT_NEAR(measure::closed_form_error(form, camera, frame_of(form, 0.2f)), 0.2, 0.005) << form.name;
    }
}

TEST(ScenesTest, aFrameThatShowsNothingHasNoError) {
    const ClosedForm form = measure::lit_plane(skin());
    scene::Frame frame = frame_of(form, 0);
    for (std::size_t i = 3; i < frame.linear.size(); i += 4) {
        frame.linear[i] = 0.5f;
    }
    EXPECT_THROW(measure::closed_form_error(form, camera, frame), support::Failure);
}

// The ground truth meets every closed form within 0.3 % of the lit level; pixels are 0.26 mm of a facing
// plane.
TEST(ScenesTest, theReferenceMeetsTheClosedForms) {
    const scene::Camera close = measure::frontal_camera(80, 20, 160, 107);
    for (const ClosedForm& form : measure::closed_forms(skin())) {
        renderer::reference::Reference reference(form.model, form.look);
        const double error =
            measure::closed_form_error(form, close, reference.render(close, form.light, true));
        EXPECT_LT(error, 0.003) << form.name;
    }
}
