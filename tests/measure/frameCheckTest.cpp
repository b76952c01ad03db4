// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "accuracy/frame_check.h"

#include <limits>

#include <gtest/gtest.h>

#include <support/error.h>

#include "pictures.h"

namespace {

using measure::Picture;

Picture covered(double radius) {
    Picture picture = pictures::disc(64, radius, 1);
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        picture.coverage.push_back(picture.linear[3 * i] > 0 ? 1.0f : 0.0f);
    }
    return picture;
}

} // namespace

TEST(FrameCheckTest, framesBecomePicturesPixelByPixel) {
    renderer::scene::Frame frame;
    frame.width = 2;
    frame.height = 1;
    frame.linear = {1, 2, 3, 0.5f, 4, 5, 6, 1};
    const Picture picture = measure::picture_of(frame, "frame");
    EXPECT_EQ(picture.linear, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(picture.coverage, (std::vector<float>{0.5f, 1}));
}

TEST(FrameCheckTest, soundFramesPass) {
    Picture image = covered(20);
    image.coverage[32 * 64 + 12] = 0.75f; // antialiasing at the edge
    EXPECT_NO_THROW(measure::check_sound(image, covered(20)));
}

TEST(FrameCheckTest, refusesWhatIsNotFinite) {
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Picture image = covered(20);
        image.linear[17] = value;
        EXPECT_THROW(measure::check_sound(image, covered(20)), support::Failure);
        image = covered(20);
        image.coverage[17] = value;
        EXPECT_THROW(measure::check_sound(image, covered(20)), support::Failure);
    }
}

// A radius of 21 in place of 20 has a tenth more pixels.
TEST(FrameCheckTest, refusesAnotherSilhouette) {
    EXPECT_THROW(measure::check_sound(covered(21), covered(20)), support::Failure);
    EXPECT_THROW(measure::check_sound(covered(19), covered(20)), support::Failure);
}
