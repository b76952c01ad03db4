// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/picture.h>

#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include <support/error.h>
#include <support/file.h>

#include "pictures.h"

namespace {

using measure::Picture;

class PictureTest : public testing::Test {
protected:
    std::string error(const std::string& name) const {
        try {
            measure::read_picture(folder.path() / name);
        } catch (const support::InputError& input_error) {
            return std::string(input_error.what()).substr(folder.path().string().size() + 1);
        }
        return "no error";
    }
    pictures::Folder folder;
};

// Values of [IEC1999]: 128 / 255 is 0.215861 of linear light, 10 / 255 lies on the linear part: / 12.92.
TEST_F(PictureTest, readsTheSignalAsLinearLight) {
    pictures::write_png8(folder.path() / "a.png", 2, 1, 3, {0, 128, 255, 10, 10, 10});
    const Picture picture = measure::read_picture(folder.path() / "a.png");
    ASSERT_EQ(picture.linear.size(), 6U);
    EXPECT_EQ(picture.linear[0], 0);
    EXPECT_NEAR(picture.linear[1], 0.2158605, 1e-6);
    EXPECT_EQ(picture.linear[2], 1);
    EXPECT_NEAR(picture.linear[3], 10 / 255.0 / 12.92, 1e-8);
    EXPECT_TRUE(picture.coverage.empty());
}

TEST_F(PictureTest, readsSixteenBits) {
    pictures::write_png16(folder.path() / "a.png", 1, 1, 3, {32768, 1000, 65535});
    const Picture picture = measure::read_picture(folder.path() / "a.png");
    EXPECT_NEAR(picture.linear[0], 0.2140482, 1e-6); // ((0.500008 + 0.055) / 1.055)^2.4
    EXPECT_NEAR(picture.linear[1], 1000 / 65535.0 / 12.92, 1e-8);
    EXPECT_EQ(picture.linear[2], 1);
}

// Half of white light is half the light, not half the signal.
TEST_F(PictureTest, alphaLetsLightThrough) {
    pictures::write_png8(folder.path() / "a.png", 1, 1, 4, {255, 255, 128, 51});
    const Picture picture = measure::read_picture(folder.path() / "a.png");
    EXPECT_NEAR(picture.coverage.at(0), 0.2, 1e-6);
    EXPECT_NEAR(picture.linear[0], 0.2, 1e-6);
    EXPECT_NEAR(picture.linear[2], 0.2 * 0.2158605, 1e-6);
}

TEST_F(PictureTest, repeatsGrey) {
    pictures::write_png8(folder.path() / "a.png", 1, 1, 1, {128});
    pictures::write_png8(folder.path() / "b.png", 1, 1, 2, {128, 255});
    pictures::write_exr(folder.path() / "c.exr", 1, 1, 1, {0.2158605f});
    for (const char* name : {"a.png", "b.png", "c.exr"}) {
        const Picture picture = measure::read_picture(folder.path() / name);
        ASSERT_EQ(picture.linear.size(), 3U) << name;
        for (const float value : picture.linear) {
            EXPECT_NEAR(value, 0.2158605, 1e-6) << name;
        }
    }
}

TEST_F(PictureTest, readsLinearLightAsItIs) {
    pictures::write_exr(folder.path() / "a.exr", 1, 1, 4, {0.125f, 40, -0.5f, 0.25f});
    const Picture picture = measure::read_picture(folder.path() / "a.exr");
    EXPECT_EQ(picture.linear, (std::vector<float>{0.125f, 40, -0.5f}));
    EXPECT_EQ(picture.coverage, std::vector<float>{0.25f});
}

TEST_F(PictureTest, namesWhereANumberIsNotFinite) {
    std::vector<float> values(4 * 6, 0.5f);
    values[4 * 4 + 1] = std::numeric_limits<float>::quiet_NaN();
    pictures::write_exr(folder.path() / "nan.exr", 3, 2, 4, values);
    EXPECT_EQ(error("nan.exr"), "nan.exr: expected finite numbers, found nan at x 1, y 1");
    values[4 * 4 + 1] = std::numeric_limits<float>::infinity();
    pictures::write_exr(folder.path() / "inf.exr", 3, 2, 4, values);
    EXPECT_EQ(error("inf.exr"), "inf.exr: expected finite numbers, found inf at x 1, y 1");
}

TEST_F(PictureTest, refusesWhatIsNoImage) {
    EXPECT_EQ(error("none.png"), "none.png: no such file");
    std::ofstream(folder.path() / "text.png") << "no image";
    EXPECT_EQ(error("text.png"),
              "text.png: expected a PNG or OpenEXR image, found 8 bytes of something else");
    std::ofstream(folder.path() / "empty.exr");
    EXPECT_EQ(error("empty.exr"),
              "empty.exr: expected a PNG or OpenEXR image, found 0 bytes of something else");
    EXPECT_NE(error("").find("expected"), std::string::npos);
}

TEST_F(PictureTest, refusesAPartOfAnImage) {
    pictures::write_square(folder.path() / "a.png", {200, 100, 50});
    pictures::write_exr(folder.path() / "a.exr", 4, 3, 3, std::vector<float>(36, 0.5f));
    for (const std::string name : {"a.png", "a.exr"}) {
        const auto bytes = support::read_bytes(folder.path() / name);
        const Picture whole = measure::read_picture(folder.path() / name);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            std::ofstream(folder.path() / ("cut" + name), std::ios::binary)
                .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(size));
            EXPECT_EQ(error("cut" + name).substr(0, 5), "cuta.") << name << ' ' << size;
        }
    }
}

TEST_F(PictureTest, refusesADamagedImage) {
    pictures::write_square(folder.path() / "a.png", {200, 100, 50});
    const auto bytes = support::read_bytes(folder.path() / "a.png");
    for (std::size_t at = 8; at < bytes.size(); ++at) {
        auto damaged = bytes;
        damaged[at] ^= 0x10;
        std::ofstream(folder.path() / "b.png", std::ios::binary)
            .write(reinterpret_cast<const char*>(damaged.data()),
                   static_cast<std::streamsize>(damaged.size()));
        EXPECT_EQ(error("b.png").substr(0, 16), "b.png: expected ") << at;
    }
}

TEST_F(PictureTest, backgroundIsTheColourThatBordersShare) {
    const Picture disc = pictures::disc(32, 10, 1);
    const Picture smaller = pictures::disc(32, 8, 1);
    const auto object = measure::object_pixels(smaller, disc);
    for (std::size_t i = 0; i < object.size(); ++i) {
        EXPECT_EQ(object[i] == 1, disc.linear[3 * i] > 0) << i;
    }
}

TEST_F(PictureTest, withoutABackgroundInCommonEveryPixelCounts) {
    const auto object = measure::object_pixels(pictures::constant(8, 8, {128, 115, 128}),
                                               pictures::constant(8, 8, {128, 128, 128}));
    EXPECT_EQ(object, std::vector<unsigned char>(64, 1));
}

} // namespace
