// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

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
