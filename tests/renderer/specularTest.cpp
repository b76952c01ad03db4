// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <renderer/optics/color.h>
#include <renderer/optics/specular.h>
#include <support/random.h>

namespace optics = renderer::optics;

// The integral a second time, by Monte Carlo over uniformly drawn directions.
TEST(SpecularTest, albedoEqualsMonteCarlo) {
    support::Generator random("specular albedo", 1);
    for (const double cos_l : {0.3, 0.7, 1.0}) {
        const double m = 0.4;
        const double f0 = 0.028;
        const double sin_l = std::sqrt(1 - cos_l * cos_l);
        double sum = 0;
        constexpr int samples = 400'000;
        for (int i = 0; i < samples; ++i) {
            const double cos_v = random.uniform();
            const double sin_v = std::sqrt(1 - cos_v * cos_v);
            const double phi = 2 * std::numbers::pi * random.uniform();
            const double h[] = {sin_l + sin_v * std::cos(phi), sin_v * std::sin(phi), cos_l + cos_v};
            const double hh = h[0] * h[0] + h[1] * h[1] + h[2] * h[2];
            const double VoH =
                (sin_v * std::cos(phi) * h[0] + sin_v * std::sin(phi) * h[1] + cos_v * h[2]) / std::sqrt(hh);
            sum += optics::beckmann(h[2] / std::sqrt(hh), m) * optics::schlick(VoH, f0) / hh * cos_v;
        }
        const double expected = 2 * sum / samples; // (1 / pi) times a solid angle of 2 pi
        // The standard error of the mean is below 0.5 % here.
        EXPECT_NEAR(optics::specular_albedo(cos_l, m, f0), expected, 0.02 * expected) << cos_l;
    }
}

TEST(SpecularTest, albedoStaysWithinBoundsOverTheWholeTable) {
    for (const float value : optics::specular_albedo_table(32, 0.028)) {
        EXPECT_TRUE(value >= 0 && value <= 1) << value;
    }
}

TEST(SpecularTest, schlickIsF0AtNormalIncidenceAndOneAtGrazing) {
    EXPECT_DOUBLE_EQ(optics::schlick(1, 0.028), 0.028);
    EXPECT_DOUBLE_EQ(optics::schlick(0, 0.028), 1);
}

// IEC 61966-2-1: middle grey 18 % is signal 0.4613561; the branches meet at 0.0031308.
TEST(ColorTest, srgbHasItsKnownValues) {
    EXPECT_NEAR(optics::srgb_from_linear(0.18), 0.4613561295, 1e-9);
    EXPECT_NEAR(optics::srgb_from_linear(0.0031308), optics::srgb_from_linear(0.0031309), 2e-6);
    for (int i = 0; i < 256; ++i) {
        EXPECT_NEAR(optics::srgb_from_linear(optics::linear_from_srgb(i / 255.0)), i / 255.0, 1e-7);
    }
}
