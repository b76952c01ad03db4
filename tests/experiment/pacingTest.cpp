// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <numeric>

#include <gtest/gtest.h>

#include "window/key_gate.h"
#include "window/pacing.h"

namespace {

using namespace experiment;

std::vector<double> swaps(double period_s, double jitter_s = 0) {
    std::vector<double> times_s;
    for (int i = 0; i <= 10; ++i) {
        times_s.push_back(5 + i * period_s + (i % 2 == 0 ? jitter_s : -jitter_s));
    }
    return times_s;
}

TEST(RefreshTest, isFoundWhereSwapsKeepTheMonitorsRate) {
    for (const double hz : {59.94, 60.0, 144.0}) {
        const Refresh refresh = judge_refresh(swaps(1 / hz), static_cast<int>(hz));
        EXPECT_TRUE(refresh.vsync) << hz;
        EXPECT_NEAR(refresh.hz, hz, 1e-6); // rounding of times near 5 s
        EXPECT_NEAR(refresh.sd_s, 0, 1e-9);
    }
}

TEST(RefreshTest, isNotFoundWhereSwapsDoNotWait) {
    EXPECT_FALSE(judge_refresh(swaps(0.0025), 0).vsync);          // Xvfb: 400 Hz, the monitor says 0 Hz
    EXPECT_FALSE(judge_refresh(swaps(1 / 60.0), 0).vsync);        // steady, but nothing that refreshes
    EXPECT_FALSE(judge_refresh(swaps(0.0005), 60).vsync);         // 2000 Hz
    EXPECT_FALSE(judge_refresh(swaps(1 / 60.0), 144).vsync);      // another rate than the monitor's
    EXPECT_FALSE(judge_refresh(swaps(1 / 60.0, 1e-3), 60).vsync); // SD 2 ms
    EXPECT_FALSE(judge_refresh(swaps(0.1), 10).vsync);            // slower than displays are
}

TEST(RefreshTest, hasTheSampleStandardDeviationOfTheIntervals) {
    // Intervals of 1, 1, 1 and 5 s: mean 2, squares 1+1+1+9, divided by n - 1 = 3.
    EXPECT_DOUBLE_EQ(judge_refresh(std::vector<double>{0, 1, 2, 3, 8}, 0).sd_s, 2);
}

TEST(FrameTest, areWhole) {
    EXPECT_EQ(whole_frames(2, 60), 120);
    EXPECT_EQ(whole_frames(2, 59.94), 120);
    EXPECT_EQ(whole_frames(2, 144), 288);
    EXPECT_EQ(whole_frames(0.001, 60), 1);
}

TEST(FrameTest, areDroppedFrom1Point2Periods) {
    EXPECT_EQ(missed_frames(1 / 60.0, 1, 60), 0);
    EXPECT_EQ(missed_frames(1.19 / 60, 1, 60), 0);
    EXPECT_EQ(missed_frames(1.21 / 60, 1, 60), 1);
    EXPECT_EQ(missed_frames(2.0 / 60, 1, 60), 1);
    EXPECT_EQ(missed_frames(3.0 / 60, 1, 60), 2);
    EXPECT_EQ(missed_frames(121 / 60.0, 120, 60), 1);
    EXPECT_EQ(missed_frames(0.3 / 60, 1, 60), 0); // a key pressed shortly before the refresh
}

TEST(RefreshTest, hasTheRateOfManySwapsMoreExactlyThanOfTheirEnds) {
    // 120 swaps at 59.94 Hz, each noticed up to a millisecond late, and one refresh missed.
    constexpr double hz = 59.94;
    std::vector<double> times_s;
    for (int i = 0; i <= 120; ++i) {
        const int refresh = i < 70 ? i : i + 1;
        times_s.push_back(5 + refresh / hz + (i % 7 == 0 ? 1e-3 : 0.0));
    }
    // Over two seconds a rate off by 0.01 Hz is a third of a millisecond.
    EXPECT_NEAR(experiment::rate_of(times_s, 60.2), hz, 0.01);
}

TEST(FrameTest, areMissedOnlyWhereNoSwapCameForThem) {
    constexpr double hz = 100;
    const auto missed = [&](std::vector<double> periods) {
        for (double& time : periods) {
            time /= hz;
        }
        return experiment::missed_refreshes(periods, hz);
    };
    EXPECT_EQ(missed({0, 1, 2, 3}), (std::vector{0, 0, 0}));
    EXPECT_EQ(missed({0, 1, 3, 4}), (std::vector{0, 1, 0}));
    EXPECT_EQ(missed({0, 1, 2, 5}), (std::vector{0, 0, 2}));
    // Noticed late; the next ones make up for it.
    EXPECT_EQ(missed({0, 1.64, 2.6, 3}), (std::vector{0, 0, 0}));
    // Late, and one truly missed, wherever that was.
    const auto late = missed({0, 1.64, 2.6, 4});
    EXPECT_EQ(std::accumulate(late.begin(), late.end(), 0), 1);
    // Swaps that do not wait miss nothing.
    EXPECT_EQ(missed({0, 0.01, 0.02, 1}), (std::vector{0, 0, 0}));
    EXPECT_EQ(missed({0, 0.01, 2, 3}), (std::vector{0, 0, 0}));
}

TEST(ClockTest, neverWakesBeforeTheDeadline) {
    for (int i = 0; i < 20; ++i) {
        const double deadline_s = monotonic_s() + 0.0005 * i;
        wait_until(deadline_s);
        EXPECT_GE(monotonic_s(), deadline_s);
    }
}

TEST(MedianTest, isTheMiddle) {
    EXPECT_EQ(median({3, 1, 100}), 3);
    EXPECT_EQ(median({5}), 5);
}

TEST(KeyGateTest, countsAPressOncePerRelease) {
    KeyGate gate;
    EXPECT_TRUE(gate.press(1));
    EXPECT_FALSE(gate.press(1)); // repeats
    EXPECT_FALSE(gate.press(1));
    gate.release(1);
    EXPECT_TRUE(gate.press(1));
}

TEST(KeyGateTest, ignoresAKeyWhileAnotherIsHeld) {
    KeyGate gate;
    EXPECT_TRUE(gate.press(1));
    EXPECT_FALSE(gate.press(2));
    gate.release(1);
    EXPECT_FALSE(gate.press(2)); // repeats of the one that came too early
    gate.release(2);
    EXPECT_TRUE(gate.press(2));
}

} // namespace
