// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <head_pigment.h>

namespace {

using stimuli::head::Pigment;
using stimuli::head::skin_colour_exact;

/// CIELAB under D65 of a linear Rec. 709 colour.
glm::dvec3 lab(glm::vec3 c) {
    const glm::dvec3 rgb(c);
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const double x = f((0.4124564 * rgb.x + 0.3575761 * rgb.y + 0.1804375 * rgb.z) / 0.95047);
    const double y = f(0.2126729 * rgb.x + 0.7151522 * rgb.y + 0.0721750 * rgb.z);
    const double z = f((0.0193339 * rgb.x + 0.1191920 * rgb.y + 0.9503041 * rgb.z) / 1.08883);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

TEST(HeadPigmentTest, putsTheSkinTypesIntoTheColourClassesOfPeople) {
    // The individual typology angle, atan((L* - 50) / b*), sorts skin from very light (above 55 degrees)
    // through light (41), intermediate (28), tan (10) and brown (-30) to dark. [Chardon1991]
    struct Class {
        float melanin;
        double low_deg, high_deg;
    };
    constexpr std::array<Class, 6> classes{{{0.006F, 55, 90},
                                            {0.0225F, 41, 55},
                                            {0.042F, 28, 41},
                                            {0.08F, 10, 28},
                                            {0.16F, -30, 10},
                                            {0.29F, -90, -30}}};
    for (const Class& skin : classes) {
        const glm::dvec3 colour = lab(skin_colour_exact({skin.melanin, 0.017F}));
        const double angle_deg = std::atan2(colour.x - 50, colour.z) * 180 / std::numbers::pi;
        EXPECT_GT(angle_deg, skin.low_deg) << skin.melanin;
        EXPECT_LT(angle_deg, skin.high_deg) << skin.melanin;
        // Redness and yellowness that colorimeters find on people of all types.
        EXPECT_GT(colour.y, 3);
        EXPECT_LT(colour.y, 16);
        EXPECT_GT(colour.z, 6);
        EXPECT_LT(colour.z, 24);
    }
}

TEST(HeadPigmentTest, darkensWithMelaninAndReddensWithBlood) {
    for (const float blood : {0.005F, 0.02F, 0.06F}) {
        for (float melanin = 0.005F; melanin < 0.45F; melanin += 0.02F) {
            const glm::vec3 less = skin_colour_exact({melanin, blood}),
                            more = skin_colour_exact({melanin + 0.02F, blood}),
                            flushed = skin_colour_exact({melanin, 1.3F * blood});
            EXPECT_TRUE(glm::all(glm::lessThan(more, less))) << melanin;
            if (melanin < 0.05F) { // more melanin hides the blood
                EXPECT_GT(flushed.x / flushed.y, less.x / less.y) << melanin << ' ' << blood;
            }
        }
    }
}

TEST(HeadPigmentTest, tableAgreesWithTheSum) {
    const stimuli::head::SkinColours colours;
    for (float melanin = 0; melanin <= 0.5F; melanin += 0.013F) {
        for (float blood = 0; blood <= 0.16F; blood += 0.007F) {
            // Half a step of 8-bit sRGB is 1/510, and less in linear light but for the brightest.
            const glm::vec3 error = colours({melanin, blood}) - skin_colour_exact({melanin, blood});
            EXPECT_LT(glm::length(error), 1 / 500.0F) << melanin << ' ' << blood;
        }
    }
}

} // namespace
