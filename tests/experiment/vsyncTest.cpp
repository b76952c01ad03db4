// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "window_fixture.h"

namespace {

using fixture::VirtualScreen;

constexpr double hz = 60, grey_s = 0.5;
constexpr int grey_frames = 30;

/// What a program that wants two processors gets of the one it gets least of, over a fifth of a second.
double least_processor_share() {
    using Clock = std::chrono::steady_clock;
    std::vector<double> shares(std::clamp(std::thread::hardware_concurrency(), 1U, 2U));
    std::vector<std::thread> threads;
    for (double& share : shares) {
        threads.emplace_back([&share] {
            const auto start = Clock::now();
            std::chrono::duration<double> wall{0};
            while (wall.count() < 0.2) {
                wall = Clock::now() - start;
            }
            timespec used{};
            ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
            share =
                (static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec)) / wall.count();
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    return *std::min_element(shares.begin(), shares.end());
}

/// A session before a display of 60 Hz, of which a library stands in for the refresh: see
/// refreshing_display.cpp.
class VsyncTest : public fixture::WindowTest {
protected:
    VsyncTest() { ::setenv("SKIN2AFC_TEST_HZ", "60", 1); }
    ~VsyncTest() override {
        ::unsetenv("LD_PRELOAD");
        ::unsetenv("SKIN2AFC_TEST_HZ");
        ::unsetenv("SKIN2AFC_TEST_DROPS");
        ::unsetenv("SKIN2AFC_TEST_CHANGED");
        ::unsetenv("SKIN2AFC_TEST_OTHER_HZ");
    }
    /// A processor that others use cannot draw in time, which is no fault of the session's.
    void SetUp() override {
        fixture::WindowTest::SetUp();
        double share = least_processor_share();
        for (int look = 0; look < 20 && share < 0.85; ++look) {
            wait_ms(1000);
            share = least_processor_share();
        }
        if (share < 0.85) {
            GTEST_SKIP() << "other programs leave " << share << " of a processor";
        }
    }
    /// Run a session that is found to be paced by the refresh; a busy machine may take more than one.
    void run_session() {
        for (int attempt = 0; attempt < 4 && facts_.value("Pacing", "") != "vsync"; ++attempt) {
            std::filesystem::remove_all(study());
            std::filesystem::remove(frames_file());
            std::filesystem::remove(folder_ / "changed");
            run_once();
            if (HasFatalFailure()) {
                return;
            }
        }
        ASSERT_EQ(facts_["Pacing"], "vsync") << facts_.dump(1);
        frames_ = fixture::read_log(frames_file());
    }
    bool still_runs() const {
        siginfo_t ended{};
        return ::waitid(P_PID, static_cast<id_t>(program_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               ended.si_pid == 0;
    }
    void run_once() {
        ::setenv("LD_PRELOAD", SKIN2AFC_REFRESHING_DISPLAY, 1);
        start(changes_ ? "[0, 60]" : "[0]", grey_s, {"--frames", frames_file().string()});
        ::unsetenv("LD_PRELOAD"); // for the session alone
        leave_instructions();
        run_trial(0, "1");
        if (changes_) {
            fixture::write(folder_ / "changed", "");
        }
        run_trial(1, "1");
        // A display that is measured anew shows the page's ground before the page.
        for (std::size_t trial = 2; trial < schedule_.size(); ++trial) {
            wait_ms(3000);
            run_trial(trial, "1");
        }
        ASSERT_TRUE(screen_.becomes(1, 1, fixture::page_ground));
        for (int press = 0; press < 40 && still_runs(); ++press) {
            wait_ms(500);
            VirtualScreen::key("space");
        }
        ASSERT_FALSE(still_runs());
        const auto outcome = finish();
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        facts_ = nlohmann::json::parse(fixture::read(sidecar()));
    }
    std::filesystem::path frames_file() const { return folder_ / "frames.tsv"; }

    /// The frames of a trial's grey, and the onset of the picture after it.
    struct Grey {
        std::vector<fixture::Row> frames;
        double end_s = 0;
        double onset_s() const { return std::stod(frames.front().at("onset")); }
        /// How many refreshes it lasted.
        double refreshes() const { return (end_s - onset_s()) * hz; }
    };
    Grey grey_of(const std::string& trial) const {
        Grey grey;
        for (const auto& row : frames_) {
            if (row.at("trial") == trial && row.at("picture") == "grey") {
                grey.frames.push_back(row);
            } else if (!grey.frames.empty() && grey.end_s == 0) {
                grey.end_s = std::stod(row.at("onset"));
            }
        }
        return grey;
    }

    /// After the first trial the display has another rate; 0: swaps wait for nothing.
    void let_change(const char* other_hz) {
        changes_ = true;
        ::setenv("SKIN2AFC_TEST_CHANGED", (folder_ / "changed").c_str(), 1);
        ::setenv("SKIN2AFC_TEST_OTHER_HZ", other_hz, 1);
    }

    bool changes_ = false;
    nlohmann::json facts_ = nlohmann::json::object();
    std::vector<fixture::Row> frames_;
};

TEST_F(VsyncTest, showsTheGreyForAWholeNumberOfFramesAndLogsEach) {
    run_session();
    ASSERT_FALSE(HasFatalFailure());
    EXPECT_NEAR(facts_["RefreshRate"].get<double>(), hz, 1); // the rate of its swaps over ten intervals
    for (const char* trial : {"1", "2"}) {
        const Grey grey = grey_of(trial);
        ASSERT_EQ(grey.frames.size(), static_cast<std::size_t>(grey_frames)) << trial;
        // A whole number; a quarter of a period is 4 ms, in which a busy machine copies a picture to the
        // screen.
        EXPECT_NEAR(grey.refreshes(), grey_frames, 0.25) << trial;
        for (std::size_t i = 0; i < grey.frames.size(); ++i) {
            EXPECT_EQ(grey.frames[i].at("frame"), std::to_string(i + 1));
            EXPECT_EQ(grey.frames[i].at("missed_frames"), "0");
        }
    }
    EXPECT_EQ(facts_["DroppedFrames"], 0);
    const auto& first = facts_["Parts"][0]["Trials"][0];
    EXPECT_EQ(first["Pictures"], 4); // number, first, grey, second
    EXPECT_EQ(first["Frames"], 4 + grey_frames - 1);
}

TEST_F(VsyncTest, countsDroppedFramesAndEndsTheGreyInTime) {
    ::setenv("SKIN2AFC_TEST_DROPS", "23", 1); // not among the swaps that measure the refresh, 12 to 22
    run_session();
    ASSERT_FALSE(HasFatalFailure());
    int dropped = 0;
    for (const char* trial : {"1", "2"}) {
        const Grey grey = grey_of(trial);
        int missed = 0;
        for (const auto& row : grey.frames) {
            missed += std::stoi(row.at("missed_frames"));
        }
        EXPECT_EQ(grey.frames.size() + static_cast<std::size_t>(missed),
                  static_cast<std::size_t>(grey_frames));
        EXPECT_GE(missed, 1) << trial;
        // Only a drop at the very last refresh makes it longer.
        EXPECT_NEAR(grey.refreshes(), grey_frames, 1.1) << trial;
        dropped += missed;
    }
    EXPECT_GE(facts_["DroppedFrames"], dropped);
    EXPECT_GE(facts_["Parts"][0]["Trials"][0]["DroppedFrames"], 1);
}

TEST_F(VsyncTest, keepsTheGreysLengthWhereSwapsNoLongerWait) {
    for (const char* rate : {"0", "120"}) {
        let_change(rate);
        facts_ = nlohmann::json::object();
        run_session();
        ASSERT_FALSE(HasFatalFailure());
        // Half a period of the refresh that was there, which the last swap was asked for early.
        EXPECT_NEAR(grey_of("2").refreshes(), grey_frames, 0.75) << rate;
        // The clock holds swaps back that wait for nothing; at 120 Hz there would be twice as many.
        EXPECT_LT(static_cast<double>(grey_of("2").frames.size()), 1.5 * grey_frames) << rate;
        const std::string events = facts_["Events"].dump();
        EXPECT_NE(events.find("swaps no longer wait"), std::string::npos) << rate;
        EXPECT_NE(events.find("the display was measured anew: the clock paces"), std::string::npos) << events;
    }
}

} // namespace
