// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "fixture.h"
#include "schedule.h"
#include "virtual_screen.h"

namespace fixture {

// The screen is larger than the pictures of 320x200, by an odd number of pixels.
constexpr int screen_width = 403, screen_height = 301;
constexpr int left = (screen_width - 320) / 2;
constexpr int top = screen_height - 200 - (screen_height - 200) / 2;  // OpenGL counts rows from below
inline constexpr std::array<std::uint8_t, 3> page_ground{38, 38, 38}; // 15 % of 255
inline constexpr std::array<std::uint8_t, 3> grey{128, 128, 128};     // 50 % of 255

/// A session of real windows, real keys and a real screen, in the full-screen window.
class WindowTest : public testing::Test {
protected:
    void start(const std::string& azimuths, double grey_s, const std::vector<std::string>& more = {}) {
        protocol_ = small_protocol(folder_.path(), azimuths, grey_s);
        write_stimuli(folder_ / "stimuli", protocol_);
        schedule_ = experiment::make_schedule(protocol_, 4);
        start_again(more);
    }
    /// The same command again.
    void start_again(const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"session",       protocol_.file.string(),
                                       "--stimuli",     (folder_ / "stimuli").string(),
                                       "--study",       study().string(),
                                       "--participant", "01",
                                       "--seed",        "4"};
        words.insert(words.end(), more.begin(), more.end());
        program_ = start_program(words, folder_.path());
    }
    /// Start, and go on to the first trial's number.
    void begin(const std::string& azimuths, double grey_s = 0.1) {
        start(azimuths, grey_s);
        leave_instructions();
    }
    ~WindowTest() override {
        if (program_ > 0) {
            ::kill(program_, SIGKILL);
            ::waitpid(program_, nullptr, 0);
        }
    }

    std::filesystem::path study() const { return folder_ / "study"; }
    std::filesystem::path log() const { return log_path(study(), "01"); }
    std::filesystem::path sidecar() const { return log().replace_extension(".json"); }

    /// The number of a trial's picture, as write_stimuli counts: shaders, then azimuths.
    int picture(std::size_t trial, bool first) const {
        const std::string& shader = first ? schedule_[trial].first : schedule_[trial].second;
        const auto& azimuths = protocol_.light.azimuths_deg;
        const auto azimuth = std::find(azimuths.begin(), azimuths.end(), schedule_[trial].azimuth_deg);
        return (shader == "no_sss" ? 0 : static_cast<int>(azimuths.size())) +
               static_cast<int>(azimuth - azimuths.begin());
    }

    /// Whether the whole screen shows the picture, pixel for pixel, with black around it.
    void expect_picture(int number) const {
        // Mesa sends a frame to the server in stripes, the top first.
        ASSERT_TRUE(screen_.becomes(left, top, pixel_of(number, 0, 0)));
        ASSERT_TRUE(screen_.becomes(left + 319, top + 199, pixel_of(number, 319, 199)));
        ASSERT_TRUE(screen_.becomes(left, top + 200, {}));
        for (const auto& [x, y] :
             {std::pair{0, 0}, {1, 0}, {0, 1}, {57, 83}, {160, 100}, {319, 0}, {0, 199}, {319, 199}}) {
            EXPECT_EQ(screen_.pixel(left + x, top + y), pixel_of(number, x, y)) << x << " " << y;
        }
        constexpr std::array<std::uint8_t, 3> black{};
        EXPECT_EQ(screen_.pixel(left - 1, top), black);
        EXPECT_EQ(screen_.pixel(left, top - 1), black);
        EXPECT_EQ(screen_.pixel(left + 320, top), black);
        EXPECT_EQ(screen_.pixel(left, top + 200), black);
    }

    static void wait_ms(int time_ms) { std::this_thread::sleep_for(std::chrono::milliseconds(time_ms)); }
    /// Wait for a page that is all there: a press before answers nothing.
    void wait_for_page() const {
        ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
        wait_ms(400);
    }
    /// From the trial's number to its first picture.
    void open_trial(std::size_t trial) const {
        wait_for_page();
        VirtualScreen::key("space");
        expect_picture(picture(trial, true));
    }
    /// From the trial's number to its answer.
    void run_trial(std::size_t trial, const std::string& answer) const {
        open_trial(trial);
        VirtualScreen::key("space");
        ASSERT_TRUE(screen_.becomes(1, 1, grey));
        EXPECT_EQ(screen_.pixel(screen_width - 1, screen_height - 1), grey);
        VirtualScreen::key("2"); // too early: the second picture is not there yet
        expect_picture(picture(trial, false));
        VirtualScreen::key(answer);
    }

    /// Ask the session at a page to end; what its sidecar says that happened.
    std::string end_and_read_events() {
        EXPECT_TRUE(screen_.becomes(1, 1, page_ground));
        ::kill(program_, SIGTERM);
        finish();
        return nlohmann::json::parse(read(sidecar()))["Events"].dump();
    }

    /// The session's last words.
    Outcome finish() {
        const auto outcome = wait_for_program(program_, folder_.path());
        program_ = -1;
        return outcome;
    }

    void leave_instructions() const {
        ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
        // The start page may not be there yet: only what it asks for ends it.
        for (int presses = 0; !std::filesystem::exists(sidecar()); ++presses) {
            ASSERT_LT(presses, 200);
            VirtualScreen::key("Return");
            wait_ms(100);
        }
        // The instructions come after the sidecar; their first key may come too early.
        wait_ms(500);
        VirtualScreen::key("space");
    }

    TemporaryFolder folder_;
    VirtualScreen screen_{folder_.path(), screen_width, screen_height};
    study::Protocol protocol_;
    experiment::Schedule schedule_;
    pid_t program_ = -1;
};

} // namespace fixture
