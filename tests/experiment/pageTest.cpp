// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <support/error.h>

#include "fixture.h"
#include "procedure.h"
#include "window/page.h"

namespace {

using namespace experiment;

/// First and last row and column that hold ink.
struct Box {
    int left, right, top, bottom;
};
Box ink_of(const Pixels& page) {
    const std::uint8_t ground = page.rgba[0];
    Box box{page.width, -1, page.height, -1};
    for (int y = 0; y < page.height; ++y) {
        for (int x = 0; x < page.width; ++x) {
            const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(page.width) +
                                 static_cast<std::size_t>(x));
            if (page.rgba[at] != ground) {
                box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y),
                       std::max(box.bottom, y)};
            }
        }
    }
    return box;
}

TEST(PageTest, isLightTextOnDarkGround) {
    const Pixels page = render_page("Trial 1 of 72", 800, 600);
    int least = 255;
    int most = 0;
    for (std::size_t red = 0; red < page.rgba.size(); red += 4) {
        least = std::min<int>(least, page.rgba[red]);
        most = std::max<int>(most, page.rgba[red]);
    }
    EXPECT_EQ(least, std::lround(255 * page_ground));
    EXPECT_NEAR(most, 255 * page_ink, 1); // strokes are wide enough for a pixel of full ink
}

TEST(PageTest, isCentred) {
    const Box ink = ink_of(render_page("HHHHHHHH\nHHHHHHHH", 800, 600));
    EXPECT_NEAR(ink.left, 799 - ink.right, 4);  // side bearings of the letters
    EXPECT_NEAR(ink.top, 599 - ink.bottom, 20); // room for descenders that this text has not
}

TEST(PageTest, keepsThePublishedTextsWithinTheScreenUnbroken) {
    const auto protocol = study::read_protocol(SKIN2AFC_PROTOCOLS "/jimenez2009.toml");
    const std::string& text = protocol.session.texts.instructions;
    const PageLayout layout = lay_out(fill_in(text, 1, 72), 1650, 988, "instructions");
    EXPECT_EQ(layout.lines.size(), static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
    // Capitals of 0.73 of the font's height are seen from 60 cm, at 0.25 mm a pixel, under more than 20
    // minutes of arc, which ISO 9241-303 recommends.
    const double minutes = std::atan2(0.73 * layout.font_px * 0.25, 600) * 180 / M_PI * 60;
    EXPECT_GT(minutes, 20);
    const Box ink = ink_of(render_page(fill_in(text, 1, 72), 1650, 988));
    EXPECT_GT(ink.left, 0);
    EXPECT_LT(ink.right, 1649);
    EXPECT_GT(ink.top, 0);
    EXPECT_LT(ink.bottom, 987);
}

TEST(PageTest, breaksLongLinesAtSpaces) {
    std::string text;
    for (int i = 0; i < 60; ++i) {
        text += "word ";
    }
    const PageLayout layout = lay_out(text, 800, 600, "text");
    EXPECT_GT(layout.lines.size(), 2U);
    for (const auto& line : layout.lines) {
        EXPECT_EQ(line.text.substr(0, 4), "word");
        EXPECT_EQ(line.text.substr(line.text.size() - 4), "word");
    }
}

TEST(PageTest, refusesATextThatDoesNotFit) {
    try {
        lay_out(std::string(100000, 'x'), 800, 600, "p.toml: session.texts.end");
        FAIL();
    } catch (const support::InputError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("p.toml: session.texts.end: expected a text that fits", 0),
                  0U);
    }
}

TEST(PageTest, hasLettersOfOtherAlphabets) {
    // A font without a letter shows the same box for all of them.
    const auto picture = [](const char* text) { return render_page(text, 300, 200).rgba; };
    EXPECT_NE(picture("\xc3\xa4"), picture("\xc3\xb6")); // a and o with diaeresis
    EXPECT_NE(picture("\xd0\x96"), picture("\xd0\xa9")); // Cyrillic zhe and shcha
    EXPECT_NE(picture("\xce\xa9"), picture("\xce\xa8")); // Greek omega and psi
    EXPECT_EQ(ink_of(render_page("", 300, 200)).right, -1);
}

} // namespace
