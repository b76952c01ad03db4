// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "window_fixture.h"

namespace {

using fixture::grey;
using fixture::left;
using fixture::page_ground;
using fixture::screen_height;
using fixture::screen_width;
using fixture::top;
using fixture::VirtualScreen;
using fixture::WindowTest;

TEST_F(WindowTest, runsASessionByRealKeysAndShowsEachPicturePixelForPixel) {
    begin("[0, 60]", 0.5);
    const std::vector<std::string> answers{"1", "2", "KP_1", "KP_2"};
    for (std::size_t trial = 0; trial < answers.size(); ++trial) {
        run_trial(trial, answers[trial]);
        if (HasFatalFailure()) {
            return;
        }
    }
    wait_for_page();
    VirtualScreen::key("space");
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("the grey was off by"), std::string::npos) << outcome.out;

    const auto rows = fixture::read_log(log());
    ASSERT_EQ(rows.size(), 4U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].at("first"), schedule_[i].first);
        EXPECT_EQ(rows[i].at("azimuth_deg"), std::to_string(schedule_[i].azimuth_deg));
        EXPECT_EQ(rows[i].at("response"), answers[i].substr(answers[i].size() - 1));
        // Paced by the clock, the grey's end is foretold from how long swaps took just before; a machine that
        // is busy then and idle at the end ends it early by a swap at most, and may end it late by any time.
        EXPECT_GE(std::stod(rows[i].at("onset_second")) - std::stod(rows[i].at("onset_grey")), 0.5 - 0.05);
        EXPECT_GT(std::stod(rows[i].at("response_time")), 0);
    }
    // A virtual screen has no refresh.
    const auto facts = nlohmann::json::parse(fixture::read(sidecar()));
    EXPECT_EQ(facts["Pacing"], "clock");
    EXPECT_EQ(facts["RefreshRate"], "n/a");
    EXPECT_EQ(facts["Complete"], true);
    EXPECT_EQ(facts["Simulated"], false);
    EXPECT_EQ(facts["StimulusPresentation"]["ScreenResolution"],
              (nlohmann::json{screen_width, screen_height}));
}

TEST_F(WindowTest, keepsEveryAnswerWhenKilled) {
    begin("[0, 60]");
    run_trial(0, "1");
    run_trial(1, "2");
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground)); // the third trial's number is drawn
    ::kill(program_, SIGKILL);
    EXPECT_EQ(finish().exit_code, -1);
    const auto rows = fixture::read_log(log());
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("response"), "1");
    EXPECT_EQ(rows[1].at("response"), "2");
    EXPECT_EQ(nlohmann::json::parse(fixture::read(sidecar()))["Complete"], false);
}

TEST_F(WindowTest, endsInOrderWhenAskedTo) {
    begin("[0]");
    run_trial(0, "1");
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
    ::kill(program_, SIGTERM);
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("1 of 2 trials are saved in"), std::string::npos) << outcome.err;
    EXPECT_EQ(nlohmann::json::parse(fixture::read(sidecar()))["TrialsAnswered"], 1);
}

TEST_F(WindowTest, takesAKeyThatIsHeldForOnePress) {
    begin("[0]");
    wait_for_page();
    VirtualScreen::key_down("space");
    expect_picture(picture(0, true));
    // X repeats a held key after 660 ms; nothing may come of that, nor of an answer while space is held.
    wait_ms(1500);
    VirtualScreen::key("1");
    expect_picture(picture(0, true));
    VirtualScreen::key_up("space");
    VirtualScreen::key("space");
    expect_picture(picture(0, false));
}

TEST_F(WindowTest, asksBeforeAClosedWindowEndsIt) {
    begin("[0]");
    open_trial(0);
    // Asked in the middle of a trial, and told to go on, it shows the trial again.
    VirtualScreen::ask_to_close();
    wait_for_page();
    VirtualScreen::key("Escape"); // does nothing
    VirtualScreen::key("1");
    VirtualScreen::key("Return");
    wait_ms(300);
    run_trial(0, "1");
    wait_for_page();
    VirtualScreen::ask_to_close();
    wait_ms(300);
    VirtualScreen::key("2");
    VirtualScreen::key("Return");
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("the window was closed; 1 of 2 trials are saved"), std::string::npos)
        << outcome.err;
    const auto facts = nlohmann::json::parse(fixture::read(sidecar()));
    EXPECT_NE(facts["Events"].dump().find("asked to close; the trial was shown again"), std::string::npos);
    EXPECT_EQ(fixture::read_log(log()).size(), 1U);
}

TEST_F(WindowTest, saysThatTheKeyboardWasElsewhere) {
    begin("[0]");
    VirtualScreen::focus(false);
    wait_ms(200);
    VirtualScreen::focus(true);
    run_trial(0, "2");
    const std::string events = end_and_read_events();
    EXPECT_NE(events.find("lost the keyboard"), std::string::npos) << events;
    EXPECT_NE(events.find("has the keyboard again"), std::string::npos) << events;
}

TEST_F(WindowTest, showsATrialAgainWhenTheScreenChanged) {
    begin("[0]");
    open_trial(0);
    const auto resize = [](const char* width, const char* height) {
        VirtualScreen::act({"search", "--name", "^skin2afc$", "windowsize", width, height});
    };
    resize("300", "150"); // smaller than the pictures: the session waits
    wait_for_page();
    resize("403", "301");
    wait_ms(300);
    VirtualScreen::key("Return");
    wait_ms(300);
    run_trial(0, "2");
    const std::string events = end_and_read_events();
    EXPECT_NE(events.find("the screen changed; the trial was shown again"), std::string::npos) << events;
    EXPECT_EQ(fixture::read_log(log()).size(), 1U);
}

TEST_F(WindowTest, takesTheFirstOfTwoKeysAtOnce) {
    begin("[0]");
    open_trial(0);
    VirtualScreen::key("space");
    ASSERT_TRUE(screen_.becomes(1, 1, grey));
    expect_picture(picture(0, false));
    VirtualScreen::act({"keydown", "2", "keydown", "1", "keyup", "2", "keyup", "1"});
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
    ASSERT_EQ(fixture::read_log(log()).size(), 1U);
    EXPECT_EQ(fixture::read_log(log())[0].at("response"), "2");
}

TEST_F(WindowTest, goesOnAfterAKillAtTheFirstTrialWithoutAnswer) {
    begin("[0, 60]");
    run_trial(0, "1");
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
    ::kill(program_, SIGKILL);
    finish();
    const std::string before = fixture::read(log());
    start_again();
    const auto parts = [&] { return nlohmann::json::parse(fixture::read(sidecar()))["Parts"].size(); };
    for (int press = 0; press < 200 && parts() < 2; ++press) {
        VirtualScreen::key("Return");
        wait_ms(100);
    }
    ASSERT_EQ(parts(), 2U);
    wait_ms(500);
    VirtualScreen::key("space");
    wait_ms(300);
    run_trial(1, "2");
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
    EXPECT_EQ(fixture::read(log()).substr(0, before.size()), before);
    const auto rows = fixture::read_log(log());
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[1].at("response"), "2");
    EXPECT_EQ(rows[1].at("first"), schedule_[1].first);
}

TEST_F(WindowTest, refusesAScreenSmallerThanThePictures) {
    std::filesystem::create_directory(folder_ / "small");
    const VirtualScreen small(folder_ / "small", 300, 200);
    start("[0]", 0.1);
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("expected at least the stimulus's 320x200 pixels, found 300x200"),
              std::string::npos)
        << outcome.err;
    EXPECT_TRUE(fixture::files_below(study()).empty());
}

} // namespace
