// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <renderer/optics/burley.h>

namespace optics = renderer::optics;

namespace {

const optics::Burley skin{{0.44, 0.22, 0.13}, {1.2, 0.7, 0.4}};

} // namespace

TEST(BurleyTest, integratesToTheAlbedo) {
    glm::dvec3 sum{0};
    constexpr double step = 1e-3;
    for (double log_r = std::log(1e-6); log_r < std::log(200.0); log_r += step) {
        const double r = std::exp(log_r + step / 2);
        sum += optics::diffuse_reflectance(skin, r) * (2 * std::numbers::pi * r * r * step);
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c] / skin.albedo[c], 1, 1e-5) << c; // what lies within 1e-6 mm is left out
    }
}

TEST(BurleyTest, shareWithinARadiusIsTheIntegralToIt) {
    for (const double radius_mm : {0.01, 0.3, 2.0}) {
        glm::dvec3 sum{0};
        constexpr int rings = 20000;
        for (int i = 0; i < rings; ++i) {
            const double r = (i + 0.5) / rings * radius_mm;
            sum += optics::diffuse_reflectance(skin, r) * (2 * std::numbers::pi * r * radius_mm / rings);
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[c] / skin.albedo[c], optics::energy_within(skin, radius_mm)[c], 1e-6);
        }
    }
}

TEST(BurleyTest, radiusAndShareAreInverses) {
    for (const double energy : {0.0, 1e-6, 0.1, 0.5, 0.9, 0.999999}) {
        const glm::dvec3 radius_mm = optics::radius_of_energy_mm(skin, energy);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(optics::energy_within(skin, radius_mm[c])[c], energy, 1e-12) << energy;
        }
    }
}

TEST(BurleyTest, itsGaussiansFollowIt) {
    const optics::Profile profile = optics::expanded(skin, "burley");
    const glm::dvec3 d = skin.mean_free_path_mm / optics::scaling(skin);
    for (double r = 0.01 * d.r; r < 8 * d.b; r *= 1.1) {
        const glm::dvec3 expected = optics::diffuse_reflectance(skin, r) / skin.albedo;
        const glm::dvec3 found = optics::diffuse_reflectance(profile, r);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c] / expected[c], 1, 1e-4) << c << ' ' << r; // the step is chosen for this
        }
    }
    glm::dvec3 sum{0};
    for (const optics::Gaussian& g : profile.gaussians) {
        sum += g.weight;
    }
    EXPECT_NEAR(sum.g, 1, 1e-12);
    EXPECT_LT(profile.gaussians.front().weight.r, 2e-3); // the cut-off holds little
}
