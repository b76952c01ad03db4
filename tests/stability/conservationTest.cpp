// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "configuration.h"
#include "images.h"
#include "models.h"

namespace stability {
namespace {

using ConservationTest = RenderingTest;

/// All of the square shows the same light, by Lambert's law, to 1/1024. Targets of 16 bits, which a user may
/// ask for, round each time: the sum of at most six Gaussians at most seven times, by 1/1024 where the driver
/// cuts off, as llvmpipe does, and by the least number of a half float.
testing::AssertionResult is_even(const Frame& frame, const Case& given, int bits) {
    const glm::vec3 light = even_light(given);
    const glm::vec3 white = white_level(given);
    for (std::size_t i = 0; i < frame.linear.size(); ++i) {
        const auto channel = static_cast<glm::length_t>(i % 4);
        if (channel == 3) {
            continue;
        }
        const float coverage = frame.linear[i - i % 4 + 3];
        const float expected = glm::mix(given.look.background[channel], light[channel], coverage);
        const float rounding =
            bits == 16 ? light[channel] * 7 / 1024 + 4e-7f * white[channel] : light[channel] / 1024;
        if (!(std::abs(frame.linear[i] - expected) <= rounding + 1e-6f * expected)) {
            const auto width = static_cast<std::size_t>(frame.width);
            return testing::AssertionFailure()
                   << "pixel " << i / 4 % width << ' ' << i / 4 / width << ", channel " << channel
                   << ", coverage " << coverage << ": expected " << expected << ", found " << frame.linear[i]
                   << ", of white " << white[channel];
        }
    }
    return testing::AssertionSuccess();
}

glm::dvec3 total_light(const Frame& frame) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < frame.linear.size(); i += 4) {
        sum += glm::dvec3(frame.linear[i], frame.linear[i + 1], frame.linear[i + 2]);
    }
    return sum;
}

} // namespace

TEST_F(ConservationTest, evenLightStaysEven) {
    std::size_t covered = 0;
    const Indices range = indices(24);
    for (std::uint64_t index = range.first; index < range.last; ++index) {
        const Case given = even(index);
        SCOPED_TRACE("SKIN2AFC_STABILITY_ONLY=" + std::to_string(index) + ", " + given.name);
        renderer::passes::Pipeline pipeline(given.model, given.look, given.methods);
        for (const Shader shader : all_shaders) {
            SCOPED_TRACE(renderer::passes::shader_name(shader));
            const Frame frame = pipeline.render(shader, given.camera, given.light, true);
            EXPECT_TRUE(
                is_even(frame, given, shader == Shader::ss_full ? given.methods.full.target_bits : 0));
            for (std::size_t i = 3; i < frame.linear.size(); i += 4) {
                covered += frame.linear[i] == 1 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(covered, 0u);
}

// A white patch on a black wall that faces the camera; scattering spreads its light, all of it inside the
// image. ss_jittered keeps it on the average alone: its kernel is narrow here, so that few pixels show the
// randomness.
TEST_F(ConservationTest, scatteringKeepsTheLightOfAPatch) {
    const Indices range = indices(16);
    for (std::uint64_t index = range.first; index < range.last; ++index) {
        const Case given = patch(index);
        SCOPED_TRACE("SKIN2AFC_STABILITY_ONLY=" + std::to_string(index) + ", " + given.name);
        // The same without a width: filters of textures, which differ between map and screen, are in both.
        Case sharp = given;
        for (renderer::optics::Gaussian& g : sharp.look.profile.gaussians) {
            g.variance_mm2 *= 1e-8;
        }
        sharp.methods.jittered.unit_mm *= 1e-4f;
        renderer::passes::Pipeline pipeline(given.model, given.look, given.methods);
        renderer::passes::Pipeline sharp_pipeline(sharp.model, sharp.look, sharp.methods);
        for (const Shader shader : all_shaders) {
            const glm::dvec3 before =
                total_light(sharp_pipeline.render(shader, given.camera, given.light, true));
            const glm::dvec3 after = total_light(pipeline.render(shader, given.camera, given.light, true));
            for (glm::length_t c = 0; c < 3; ++c) {
                const bool half_floats = shader == Shader::ss_full && given.methods.full.target_bits == 16;
                EXPECT_GT(before[c], 0);
                EXPECT_NEAR(after[c] / before[c], 1, half_floats ? 0.012 : 0.005)
                    << renderer::passes::shader_name(shader) << ' ' << c;
            }
        }
    }
}

} // namespace stability
