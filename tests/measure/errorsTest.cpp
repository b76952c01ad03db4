// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/errors.h>

#include <cmath>

#include <gtest/gtest.h>

#include <measure/color.h>
#include <support/error.h>

#include "pictures.h"

namespace {

using measure::Errors;
using measure::Picture;

Errors errors(const Picture& image, const Picture& reference) {
    return measure::compare(image, reference, measure::default_pixels_per_degree()).errors;
}

/// A disc before black, its coverage told.
Picture covered_disc(float scale) {
    Picture picture = pictures::disc(64, 20, scale);
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        picture.coverage.push_back(picture.linear[3 * i] > 0 ? 1.0f : 0.0f);
    }
    return picture;
}

} // namespace

TEST(ErrorsTest, areNoneForTheSamePicture) {
    const Picture picture = pictures::noisy(pictures::disc(48, 15, 1), 0.05, 1);
    const Errors e = errors(picture, picture);
    EXPECT_EQ(e.rmse, 0);
    EXPECT_EQ(e.rmse_all, 0);
    EXPECT_EQ(e.psnr_db, std::numeric_limits<double>::infinity());
    EXPECT_EQ(e.de2000_mean, 0);
    EXPECT_EQ(e.de2000_p95, 0);
    EXPECT_NEAR(e.ssim, 1, 1e-6); // float rounding
    EXPECT_EQ(e.flip, 0);
}

// Light that is 0.1 too high everywhere: RMSE 0.1, PSNR 20 dB over the object, whatever the background; over
// all pixels the root of the object's share less. Floats hold 0.5 and 0.6 to 3e-8.
TEST(ErrorsTest, countLightOverTheObject) {
    for (const bool with_coverage : {false, true}) {
        const Picture reference = with_coverage ? covered_disc(1) : pictures::disc(64, 20, 1);
        const Picture image = with_coverage ? covered_disc(1.2f) : pictures::disc(64, 20, 1.2f);
        const Errors e = errors(image, reference);
        EXPECT_NEAR(static_cast<double>(e.object_pixels), 400 * 3.14159, 20); // a circle of pixels
        EXPECT_NEAR(e.rmse, 0.1, 1e-7);
        EXPECT_NEAR(e.psnr_db, 20, 1e-5);
        EXPECT_NEAR(e.rmse_all, 0.1 * std::sqrt(static_cast<double>(e.object_pixels) / 4096), 1e-7);
    }
}

// Two greys: the difference of one colour is that of all, at both ends of the distribution.
TEST(ErrorsTest, countColorOverTheObject) {
    const Errors e = errors(pictures::disc(64, 20, 1.2f), pictures::disc(64, 20, 1));
    const double expected = measure::ciede2000(measure::lab_from_linear(glm::dvec3(0.6)),
                                               measure::lab_from_linear(glm::dvec3(0.5)));
    EXPECT_GT(expected, 3);
    EXPECT_NEAR(e.de2000_mean, expected, 1e-5);
    EXPECT_NEAR(e.de2000_p95, expected, 1e-5);
}

// Of 100 pixels, the 95th percentile is the difference of the 95th: 6 wrong ones show, 5 do not.
TEST(ErrorsTest, percentileLeavesFivePercentOut) {
    const Picture reference = pictures::constant(10, 10, {128, 128, 128});
    for (const int wrong : {5, 6}) {
        Picture image = pictures::constant(10, 10, {127, 128, 128}); // no colour in common: all pixels count
        for (int i = 0; i < wrong; ++i) {
            image.linear[static_cast<std::size_t>(3 * i)] = 1;
        }
        const Errors e = errors(image, reference);
        EXPECT_EQ(e.object_pixels, 100U);
        EXPECT_EQ(e.de2000_p95 > 5, wrong == 6) << e.de2000_p95;
    }
}

TEST(ErrorsTest, growWithNoise) {
    const Picture reference = pictures::disc(64, 25, 1);
    Errors before;
    before.ssim = 1;
    before.psnr_db = std::numeric_limits<double>::infinity();
    for (const double sigma : {0.01, 0.03, 0.1}) {
        const Errors now = errors(pictures::noisy(reference, sigma, 5), reference);
        EXPECT_GT(now.rmse, before.rmse);
        EXPECT_LT(now.psnr_db, before.psnr_db);
        EXPECT_GT(now.de2000_mean, before.de2000_mean);
        EXPECT_GT(now.de2000_p95, before.de2000_p95);
        EXPECT_LT(now.ssim, before.ssim);
        EXPECT_GT(now.flip, before.flip);
        before = now;
    }
}

TEST(ErrorsTest, refuseTwoSizesAndEmptyPictures) {
    const auto message = [](const Picture& image, const Picture& reference) {
        try {
            errors(image, reference);
        } catch (const support::InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const Picture disc = pictures::disc(32, 10, 1);
    EXPECT_EQ(message(pictures::disc(16, 5, 1), disc),
              "disc: expected the 32x32 pixels of disc, found 16x16");
    const Picture empty = pictures::constant(32, 32, {0, 0, 0});
    const std::string background = "constant: expected an object before a background, found background alone";
    EXPECT_EQ(message(empty, disc), background);
    EXPECT_EQ(message(disc, empty), background);
    Picture uncovered = disc;
    uncovered.coverage.assign(uncovered.pixels(), 0);
    EXPECT_NE(message(uncovered, disc).find("found background alone"), std::string::npos);
}

// [Andersson2020]: 0.7 m of 3840 pixels seen from 0.7 m are 67.02 pixels per degree.
TEST(ErrorsTest, viewingConditionsAreThoseOfFlip) {
    EXPECT_NEAR(measure::default_pixels_per_degree(), 67.02, 0.005);
    EXPECT_NEAR(measure::pixels_per_degree(700, 3840, 1400), 2 * 67.0206, 1e-3);
}
