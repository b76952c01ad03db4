// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <numeric>

#include <gtest/gtest.h>

#include <support/text_raster.h>

namespace {

long ink(const char* text) {
    const support::TextRaster raster = support::text_raster(text, 32);
    return std::accumulate(raster.coverage.begin(), raster.coverage.end(), 0L);
}

} // namespace

TEST(TextRasterTest, isAsWideAsItSays) {
    for (const char* text : {"Trial 1 of 72", "60°", "größer", "実験"}) {
        EXPECT_EQ(support::text_raster(text, 20).width, support::text_width(text, 20)) << text;
    }
    EXPECT_EQ(support::text_width("aa", 20), 2 * support::text_width("a", 20));
}

// A degree sign is a small ring: less ink than the zero it could be mistaken for, and none at the baseline.
TEST(TextRasterTest, drawsLettersBeyondAscii) {
    EXPECT_LT(ink("°"), ink("0") / 2);
    EXPECT_GT(ink("°"), 0);
    EXPECT_GT(ink("é"), ink("e"));
    EXPECT_NE(ink("ж"), ink("ц"));
    const support::TextRaster degree = support::text_raster("°", 32);
    for (int x = 0; x < degree.width; ++x) {
        EXPECT_EQ(degree.coverage[static_cast<std::size_t>((degree.baseline - 2) * degree.width + x)], 0);
    }
}

TEST(TextRasterTest, cutsNoLetterOff) {
    for (const int size_px : {9, 13, 16, 21, 33}) {
        const support::TextRaster raster = support::text_raster("gjpqyÅÜç(|", size_px);
        for (int x = 0; x < raster.width; ++x) {
            EXPECT_EQ(raster.coverage[static_cast<std::size_t>(x)], 0) << size_px;
            EXPECT_EQ(raster.coverage[raster.coverage.size() - 1 - static_cast<std::size_t>(x)], 0)
                << size_px;
        }
    }
}

TEST(TextRasterTest, showsBytesThatAreNotUtf8AsReplacements) {
    EXPECT_EQ(support::text_width("\xff", 32), support::text_width("\xef\xbf\xbd", 32));
    EXPECT_EQ(support::text_width("\xc3", 32), support::text_width("\xef\xbf\xbd", 32)); // cut off
    EXPECT_EQ(support::text_raster("", 32).width, 1);
}
