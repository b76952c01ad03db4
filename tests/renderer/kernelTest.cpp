// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>

#include <gtest/gtest.h>

#include <renderer/optics/kernel.h>

namespace optics = renderer::optics;

TEST(KernelTest, hableWeightsAddUpToOneInEachChannel) {
    glm::vec3 sum{0};
    for (const optics::Tap& tap : optics::hable_kernel()) {
        sum += tap.weight;
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c], 1, 1e-6f); // float rounding of 13 terms
    }
}

// Computed from the published table by hand: 3.15, 1.37 and 0.87 kernel units.
TEST(KernelTest, hableRadiiAreThePublishedOnes) {
    const glm::vec3 radius = optics::rms_radius(optics::hable_kernel());
    EXPECT_NEAR(radius.r, 3.15, 0.005);
    EXPECT_NEAR(radius.g, 1.37, 0.005);
    EXPECT_NEAR(radius.b, 0.87, 0.005);
}

TEST(KernelTest, gaussianTapsAreSymmetricWithUnitSumAndNearlyUnitVariance) {
    float sum = 0;
    float variance = 0;
    for (int i = 0; i < 7; ++i) {
        const float weight = optics::gaussian_taps[static_cast<std::size_t>(i)];
        EXPECT_EQ(weight, optics::gaussian_taps[static_cast<std::size_t>(6 - i)]);
        sum += weight;
        variance += weight * static_cast<float>((i - 3) * (i - 3));
    }
    EXPECT_NEAR(sum, 1, 1e-6f);
    EXPECT_NEAR(variance, 1.08, 1e-3); // the published weights are 4 % too wide in standard deviation
}

// Moments by hand: weights ratio^(k^2), normalised, must have the variance asked for.
TEST(KernelTest, tapRatioGivesTheVarianceAskedFor) {
    for (const int reach : {1, 3, 12}) {
        for (const double sigma : {0.0, 0.1, 0.3, 0.7}) {
            const double ratio = optics::tap_ratio(reach, sigma);
            double sum = 1;
            double variance = 0;
            for (int k = 1; k <= reach; ++k) {
                sum += 2 * std::pow(ratio, k * k);
                variance += 2 * k * k * std::pow(ratio, k * k);
            }
            EXPECT_NEAR(variance / sum, sigma * sigma, 1e-9) << reach << ' ' << sigma;
        }
    }
    // Wide Gaussians weigh their taps as the Gaussian does.
    EXPECT_NEAR(optics::tap_ratio(25, 3), std::exp(-1.0 / 18), 1e-6);
}

// A sunflower's mean squared radius is the profile's own, up to the light that its outermost tap stands for.
TEST(KernelTest, sunflowerFollowsTheProfile) {
    const optics::Profile profile = optics::profile("skin_6g_deon2007");
    for (const int count : {25, 49}) {
        const std::vector<optics::Tap> taps = optics::sunflower_kernel(profile, count);
        ASSERT_EQ(taps.size(), static_cast<std::size_t>(count));
        glm::vec3 sum{0};
        for (const optics::Tap& tap : taps) {
            sum += tap.weight;
        }
        const glm::vec3 radius = optics::rms_radius(taps);
        const glm::dvec3 truth = optics::rms_radius_mm(profile);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[c], 1, 1e-5f);
            EXPECT_NEAR(static_cast<double>(radius[c]) / truth[c], 1, 0.12) << count << ' ' << c;
        }
    }
}
