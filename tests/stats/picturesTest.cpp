// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "pictures.h"

#include <gtest/gtest.h>

#include <support/error.h>

#include "report.h"
#include "study_folder.h"

namespace {

using stats::Picture;

Picture plain(int width, int height, std::uint8_t level) {
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), level)};
}

TEST(PicturesTest, encodingKeepsEveryPixel) {
    Picture picture = plain(5, 3, 0);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] = static_cast<std::uint8_t>(17 * i);
    }
    const Picture read = stats::decoded(stats::encoded(picture), "x.png");
    EXPECT_EQ(read.width, 5);
    EXPECT_EQ(read.height, 3);
    EXPECT_EQ(read.rgb, picture.rgb);
}

TEST(PicturesTest, thumbnailsAreMeansOfSquares) {
    Picture picture = plain(4, 2, 0);
    picture.rgb[3 * 2] = 40; // the right square's red: 40, 0, 0, 82: 30.5
    picture.rgb[3 * (4 + 3)] = 82;
    const Picture small = stats::thumbnail(picture, 2);
    EXPECT_EQ(small.width, 2);
    EXPECT_EQ(small.height, 1);
    EXPECT_EQ(small.rgb, (std::vector<std::uint8_t>{0, 0, 0, 31, 0, 0}));
    EXPECT_EQ(stats::thumbnail(picture, 99).rgb, picture.rgb); // never enlarged
}

TEST(PicturesTest, differencesAreAbsoluteAmplifiedAndBounded) {
    Picture a = plain(1, 1, 100), b = plain(1, 1, 100);
    b.rgb = {98, 101, 200};
    EXPECT_EQ(stats::difference(a, b, 75).rgb, (std::vector<std::uint8_t>{150, 75, 255}));
    EXPECT_EQ(stats::difference(b, a, 75).rgb, stats::difference(a, b, 75).rgb);
}

TEST(PicturesTest, standBesideTheirNumbers) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtr") + log_line(4, 'r', "no_sss"));
    folder.write("stimuli/ts_far_060.png", stats::encoded(plain(480, 240, 100)));
    folder.write("stimuli/ss_full_far_060.png", stats::encoded(plain(480, 240, 101)));
    const auto analysis = stats::analyse_study(folder.path());
    const auto pictures = condition_pictures(analysis.rows, kept_stimuli(analysis.study, folder.path()));
    ASSERT_EQ(pictures.size(), 2u); // no_sss, ss_full
    EXPECT_FALSE(pictures[0]);
    ASSERT_TRUE(pictures[1]);
    const Picture difference = stats::decoded(pictures[1]->difference, "x");
    EXPECT_EQ(difference.width, 240);
    EXPECT_EQ(difference.rgb.front(), 75);
    const std::string svg = "<svg></svg>",
                      html = report_html(analysis, {svg, svg, svg, pictures, std::nullopt});
    EXPECT_NE(html.find("2 of 3 chose TS, p = 0.564"), std::string::npos); // chi-square 1/3
    EXPECT_NE(html.find("src=\"data:image/png;base64,iVBOR"), std::string::npos);
}

/// A sidecar whose manifest's digest is one digit over and over.
std::string sidecar_of(char digit) {
    return fmt::format(R"({{"StimuliManifestDigest": "{}"}})", std::string(64, digit));
}

/// The picture's difference at the first condition: 75 times what ss_full's level is above 100.
int shown_difference(const StudyFolder& folder) {
    const auto analysis = stats::analyse_study(folder.path());
    const auto pictures = condition_pictures(analysis.rows, kept_stimuli(analysis.study, folder.path()));
    return pictures.front() ? stats::decoded(pictures.front()->difference, "x").rgb.front() / 75 : 0;
}

TEST(PicturesTest, areTheCopiesOfWhatMostRunsShowed) {
    const StudyFolder folder;
    const auto keep = [&](const std::string& place, std::uint8_t level) {
        folder.write(place + "/ts_far_060.png", stats::encoded(plain(8, 8, 100)));
        folder.write(place + "/ss_full_far_060.png", stats::encoded(plain(8, 8, level)));
    };
    const std::string a = "stimuli/aaaaaaaaaaaa", b = "stimuli/bbbbbbbbbbbb";
    for (const auto& [label, digit] : {std::pair("1", 'a'), {"2", 'b'}, {"3", 'b'}}) {
        folder.write_log(label, log_text("r"));
        folder.write_sidecar(label, sidecar_of(digit));
    }
    EXPECT_EQ(shown_difference(folder), 0);
    keep("stimuli", 101);
    EXPECT_EQ(shown_difference(folder), 1);
    keep(a, 102);
    EXPECT_EQ(shown_difference(folder), 2);
    keep(b, 103);
    EXPECT_EQ(shown_difference(folder), 3);
    // Half a pair is none.
    fs::remove(folder.path() / b / "ts_far_060.png");
    EXPECT_EQ(shown_difference(folder), 2);
}

TEST(PicturesTest, aDigestThatIsNoneLeadsNowhere) {
    // Some of these, taken for digits, would lead out of the folder of stimuli.
    const StudyFolder folder;
    folder.write("ts_far_060.png", stats::encoded(plain(8, 8, 100)));
    folder.write("ss_full_far_060.png", stats::encoded(plain(8, 8, 102)));
    fs::create_directories(folder.path() / "stimuli");
    folder.write_log("1", log_text("r"));
    for (const std::string& digest : {std::string("n/a"), std::string(""), std::string("../"),
                                      "../././././././" + std::string(50, 'a'), std::string(64, 'A')}) {
        folder.write_sidecar("1", fmt::format(R"({{"StimuliManifestDigest": "{}"}})", digest));
        EXPECT_EQ(shown_difference(folder), 0) << digest;
    }
}

TEST(PicturesTest, brokenAndUnlikePicturesAreNotShown) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtr"));
    const auto rows = stats::analyse_study(folder.path()).rows;
    const std::vector<fs::path> folders{folder.path()};
    const auto whole = stats::encoded(plain(8, 8, 1));
    folder.write("ts_far_060.png", whole);
    folder.write("ss_full_far_060.png", stats::encoded(plain(8, 9, 1)));
    EXPECT_FALSE(condition_pictures(rows, folders).front());
    std::string broken = whole;
    broken[20] ^= 1; // in the header's width
    folder.write("ss_full_far_060.png", broken);
    const auto message = message_of<support::InputError>([&] { condition_pictures(rows, folders); });
    EXPECT_NE(message.find("ss_full_far_060.png: expected a PNG picture, found: "), std::string::npos)
        << message;
}

} // namespace
