// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/flip.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include <gtest/gtest.h>

#include <measure/errors.h>

#include "pictures.h"

namespace {

using measure::Picture;

double mean_flip(const Picture& image, const Picture& reference,
                 double ppd = measure::default_pixels_per_degree()) {
    const auto map = measure::flip_map(image.linear, reference.linear, image.width, image.height, ppd);
    return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

/// Each pixel as a square of four.
Picture doubled(const Picture& picture) {
    Picture result{picture.name, 2 * picture.width, 2 * picture.height, {}, {}};
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const auto at = 3 * static_cast<std::ptrdiff_t>(y / 2 * picture.width + x / 2);
            result.linear.insert(result.linear.end(), picture.linear.begin() + at,
                                 picture.linear.begin() + at + 3);
        }
    }
    return result;
}

} // namespace

// What the authors' own program (FLIP 1.6, default viewing conditions) gives for these pairs, to six digits;
// ours differs by float rounding and by the digits of D65.
TEST(FlipTest, reproducesTheAuthorsProgram) {
    EXPECT_NEAR(mean_flip(pictures::checker(240, 180, 3, 1), pictures::checker(240, 180, 0, 0)), 0.287737,
                1e-5);
    EXPECT_NEAR(
        mean_flip(pictures::constant(64, 64, {128, 115, 128}), pictures::constant(64, 64, {128, 128, 128})),
        0.251148, 1e-5);
}

// The same for renderings of a head, where they are at hand: SKIN2AFC_FLIP_PAIRS names their folder.
TEST(FlipTest, reproducesTheAuthorsProgramOnHeads) {
    const char* folder = std::getenv("SKIN2AFC_FLIP_PAIRS");
    if (folder == nullptr) {
        GTEST_SKIP() << "SKIN2AFC_FLIP_PAIRS names no folder";
    }
    const std::filesystem::path path(folder);
    const Picture reference = measure::read_picture(path / "head_reference.png");
    EXPECT_NEAR(mean_flip(measure::read_picture(path / "head_noisy.png"), reference), 0.008176, 1e-5);
    EXPECT_NEAR(mean_flip(measure::read_picture(path / "head_blurred.png"), reference), 0.029649, 1e-5);
}

TEST(FlipTest, isZeroForTheSamePicture) {
    const Picture picture = pictures::noisy(pictures::checker(64, 48, 0, 0), 0.1, 1);
    EXPECT_EQ(mean_flip(picture, picture), 0);
}

// Green and blue are the farthest apart: to them FLIP is scaled [Andersson2020, Sec. 4.1]. The filters'
// weights sum to 1 within float rounding.
TEST(FlipTest, isOneBetweenGreenAndBlue) {
    EXPECT_NEAR(mean_flip(pictures::constant(32, 32, {0, 255, 0}), pictures::constant(32, 32, {0, 0, 255})),
                1, 1e-5);
}

TEST(FlipTest, isSymmetric) {
    const Picture picture = pictures::checker(64, 48, 0, 0);
    const Picture other = pictures::noisy(picture, 0.2, 2);
    EXPECT_EQ(mean_flip(picture, other), mean_flip(other, picture));
}

TEST(FlipTest, growsWithNoise) {
    const Picture picture = pictures::checker(96, 96, 0, 0);
    double before = 0;
    for (const double sigma : {0.003, 0.01, 0.03, 0.1}) {
        const double now = mean_flip(pictures::noisy(picture, sigma, 3), picture);
        EXPECT_GT(now, 1.3 * before) << sigma;
        before = now;
    }
}

// Pixels half as large at twice as many a degree look the same, but that filters of more taps move the mean
// by some per cent; noise of the same pixels at twice as many a degree is harder to see.
TEST(FlipTest, dependsOnTheVisualAngleAlone) {
    const Picture reference = pictures::checker(96, 96, 0, 0);
    const Picture image = pictures::noisy(reference, 0.1, 4);
    const double plain = mean_flip(image, reference, 60);
    EXPECT_NEAR(mean_flip(doubled(image), doubled(reference), 120) / plain, 1, 0.05);
    EXPECT_LT(mean_flip(image, reference, 120), 0.8 * plain);
}

TEST(FlipTest, isFiniteForLightThatNoDisplayShows) {
    Picture image = pictures::constant(16, 16, {255, 255, 255});
    Picture reference = image;
    for (std::size_t i = 0; i < image.linear.size(); ++i) {
        image.linear[i] = i % 2 == 0 ? 3e38f : -3e38f;
    }
    const double value = mean_flip(image, reference);
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
}
