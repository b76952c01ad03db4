// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <renderer/optics/profile.h>
#include <support/error.h>

namespace optics = renderer::optics;

namespace {

/// Energy within a radius by the midpoint rule over rings.
glm::dvec3 energy_within(const optics::Profile& profile, double radius_mm) {
    glm::dvec3 sum{0};
    constexpr double step_mm = 1e-3;
    for (double r = step_mm / 2; r < radius_mm; r += step_mm) {
        sum += optics::diffuse_reflectance(profile, r) * (2 * std::numbers::pi * r * step_mm);
    }
    return sum;
}

} // namespace

TEST(ProfileTest, integratesToOne) {
    for (const char* name : {"skin_6g_deon2007", "skin_4g_jimenez2010", "marble_4g_jimenez2010"}) {
        const glm::dvec3 energy = energy_within(optics::profile(name), 30);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(energy[c], 1, 1e-4) << name; // error of the midpoint rule at the narrowest Gaussian
        }
    }
}

// Published facts about the six-Gaussian skin: radii to two decimals, and 99 % of the red light within 6 mm.
TEST(ProfileTest, hasTheRadiiOfSkin) {
    const optics::Profile skin = optics::profile("skin_6g_deon2007");
    const glm::dvec3 radius_mm = optics::rms_radius_mm(skin);
    EXPECT_NEAR(radius_mm.r, 1.66, 0.005);
    EXPECT_NEAR(radius_mm.g, 0.37, 0.005);
    EXPECT_NEAR(radius_mm.b, 0.22, 0.005);
    EXPECT_NEAR(energy_within(skin, 6).r, 0.99, 0.005);
}

TEST(ProfileTest, cascadeReachesEachVariance) {
    const optics::Profile skin = optics::profile("skin_6g_deon2007");
    double reached_mm2 = 0;
    const std::vector<double> sigmas = optics::cascade_sigmas_mm(skin);
    ASSERT_EQ(sigmas.size(), 6u);
    const double stated[] = {.0800, .2049, .3723, .6164, 1.1929, 2.3281};
    for (std::size_t i = 0; i < 6; ++i) {
        reached_mm2 += sigmas[i] * sigmas[i];
        EXPECT_NEAR(reached_mm2, skin.gaussians[i].variance_mm2, 1e-12);
        EXPECT_NEAR(sigmas[i], stated[i], 5e-5); // stated to four decimals
    }
}

// [JimenezGutierrez2010, Table 7.1] prints the blend factors w_i / (w_1 + ... + w_i) beside the weights.
TEST(ProfileTest, fourGaussianWeightsGiveThePrintedBlendFactors) {
    const optics::Profile marble = optics::profile("marble_4g_jimenez2010");
    const glm::dvec3 printed[] = {
        {1, 1, 1}, {.8173, .6616, .4647}, {.5101, .4617, .4791}, {.3913, .3161, .2189}};
    glm::dvec3 sum{0};
    for (std::size_t i = 0; i < 4; ++i) {
        sum += marble.gaussians[i].weight;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(marble.gaussians[i].weight[c] / sum[c], printed[i][c],
                        3e-4); // weights are rounded to 1e-4
        }
    }
}

TEST(ProfileTest, refusesUnknownNames) { EXPECT_THROW(optics::profile("cheese"), support::InputError); }
