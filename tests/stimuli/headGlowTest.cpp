// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <renderer/reference/reference.h>

#include "head_under_test.h"

namespace {

namespace scene = renderer::scene;

/// Linear light of the left ear and the temple, seen from the front of its side, the light behind them.
scene::Frame lit_from_behind(const renderer::optics::Profile& profile) {
    scene::Look look;
    look.profile = profile;
    look.specular_intensity = 0;
    scene::Light light;
    light.direction = scene::light_direction(3.6F, 0.3F);
    light.irradiance = glm::vec3(3.14159265F);
    const glm::vec3 ear(84, -8, -22);
    const scene::Camera camera{ear + 400.0F * scene::light_direction(0.7F, 0), ear, 0.25F, 100, 100};
    renderer::reference::Settings settings;
    settings.samples_per_side = 2;
    settings.cells_per_sigma = 0.6;
    return renderer::reference::Reference(head(), look, settings).render(camera, light, true);
}

// The truth for light through thin parts: the reference sums what enters anywhere on the surface.
TEST(HeadGlowTest, earsGlowRedWhenLitFromBehind) {
    renderer::optics::Profile none;
    none.gaussians = {{0, glm::dvec3(1)}};
    const scene::Frame scattered = lit_from_behind(renderer::optics::profile("skin_6g_deon2007"));
    const scene::Frame unscattered = lit_from_behind(none);
    int glows = 0, unlit = 0;
    for (std::size_t i = 0; i < scattered.linear.size(); i += 4) {
        const bool skin = scattered.linear[i + 3] == 1, lit = unscattered.linear[i] > 0;
        if (!skin || lit) {
            continue;
        }
        ++unlit;
        // White skin that faces the light would be 1.
        if (scattered.linear[i] > 0.01F && scattered.linear[i] > 4 * scattered.linear[i + 1]) {
            ++glows;
        }
    }
    EXPECT_GT(unlit, 4000);
    // A pixel is 1 mm: an ear's rim, 60 mm long, some millimetres wide.
    EXPECT_GT(glows, 40);
    EXPECT_LT(glows, 400) << "thick parts stay dark";
}

} // namespace
