// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <numbers>

#include <gtest/gtest.h>

#include "fixture.h"
#include "timing_test.h"
#include "virtual_screen.h"
#include "window/display.h"

namespace {

experiment::TimingFindings findings(std::vector<double> grey_error_s) {
    experiment::TimingFindings all;
    all.monitor = "1";
    all.pacing = "vsync";
    all.refresh_hz = 60;
    all.grey_s = 2;
    all.grey_error_s = std::move(grey_error_s);
    all.swap_s = {0.001};
    return all;
}

TEST(TimingReportTest, judgesSizesWhateverTheirSign) {
    const auto says = [](const experiment::TimingFindings& all, const char* words) {
        return experiment::timing_report(all).find(words) != std::string::npos;
    };
    EXPECT_TRUE(says(findings({0.0005, -0.0006, 0.0019}), "This machine: acceptable"));
    EXPECT_TRUE(says(findings({0.0005, -0.0006, 0.0019}), "median 0.600 ms, worst 1.900 ms"));
    EXPECT_TRUE(says(findings({0.0005, -0.0006, -0.0021}), "not acceptable"));
    EXPECT_TRUE(says(findings({-0.0011, -0.0011, -0.0011}), "not acceptable"));
    auto dropping = findings({0});
    dropping.dropped_frames = 1;
    EXPECT_TRUE(says(dropping, "not acceptable"));
}

TEST(TimingWarningTest, comesWhereAGreyIsOffByMoreThanIsAcceptable) {
    constexpr double grey_s = 0.5;
    const auto warns = [&](const experiment::StageFacts& facts, std::vector<double> grey_error_s) {
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        experiment::tell_timing(facts, grey_s, {.grey_error_s = std::move(grey_error_s), .save_s = {}});
        testing::internal::GetCapturedStdout();
        return !testing::internal::GetCapturedStderr().empty();
    };
    EXPECT_FALSE(warns({}, {0.0005, -0.0019, 0.0005}));
    EXPECT_TRUE(warns({}, {0.0005, -0.0021, 0.0005}));
    EXPECT_TRUE(warns({}, {0.0011, -0.0011, 0.0011})) << "the median, too";
    // At 75 Hz the nearest to half a second are 38 frames (37.5 round up), 6.7 ms more.
    experiment::StageFacts paced;
    paced.refresh_hz = 75;
    EXPECT_FALSE(warns(paced, {38 / 75.0 - grey_s}));
    EXPECT_TRUE(warns(paced, {0}));
    experiment::StageFacts dropping;
    dropping.dropped_frames = 1;
    EXPECT_TRUE(warns(dropping, {0.0005}));
    experiment::StageFacts simulated;
    simulated.observer = "null";
    EXPECT_FALSE(warns(simulated, {1}));
}

TEST(TimingTestCommandTest, printsHowToReadItWithoutAnythingElse) {
    const fixture::TemporaryFolder folder;
    const fixture::VirtualScreen screen(folder.path(), 320, 200);
    const auto outcome = fixture::run_program({"session", "--timing-test", "1"});
    // A busy machine may be found not acceptable.
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << outcome.err;
    for (const char* words : {"320 x 200", "How to read it", "Acceptable are", "This machine:"}) {
        EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
    }
}

TEST(VisualAngleTest, isThatOfTheTriangle) {
    // A screen as wide as twice its distance is seen under a right angle.
    EXPECT_NEAR(experiment::visual_angle_deg(1200, 600), 90, 1e-9); // rounding
    // For small angles it is the quotient.
    EXPECT_NEAR(experiment::visual_angle_deg(1, 10000), 1e-4 * 180 / std::numbers::pi, 1e-9);
}

} // namespace
