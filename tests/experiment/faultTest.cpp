// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cstdlib>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <unistd.h>

#include "window_fixture.h"

namespace {

namespace fs = std::filesystem;
using fixture::grey;
using fixture::page_ground;
using fixture::VirtualScreen;
using fixture::WindowTest;

/// Faults that are made while a participant sits at the screen.
class FaultTest : public WindowTest {
protected:
    /// Answer the page that says what failed.
    void try_again() const {
        wait_ms(700);
        VirtualScreen::key("1");
        VirtualScreen::key("Return");
        wait_ms(700);
    }
    bool runs() const { return ::waitpid(program_, nullptr, WNOHANG) == 0; }
    std::vector<std::string> study_files() const { return fixture::files_below(study()); }
};

TEST_F(FaultTest, bringsBackAStudyThatWasMovedAway) {
    begin("[0, 60]");
    run_trial(0, "1");
    wait_for_page();
    const auto files = study_files();
    fs::rename(study(), folder_ / "moved");
    run_trial(1, "2");
    try_again();
    EXPECT_EQ(study_files(), files);
    ASSERT_EQ(fixture::read_log(log()).size(), 2U);
    EXPECT_EQ(fixture::read_log(fixture::log_path(folder_ / "moved", "01")).size(), 1U);
    ::kill(program_, SIGTERM);
    finish();
    EXPECT_NE(fixture::read(sidecar()).find("was deleted or moved while the session ran"), std::string::npos);
}

TEST_F(FaultTest, keepsTheAnswerWhileAFileStandsInTheStudysPlace) {
    begin("[0, 60]");
    run_trial(0, "1");
    wait_for_page();
    const auto files = study_files();
    fs::remove_all(study());
    fixture::write(study(), "");
    run_trial(1, "2");
    try_again();
    ASSERT_TRUE(runs());
    fs::remove(study());
    try_again();
    EXPECT_EQ(study_files(), files);
    ASSERT_EQ(fixture::read_log(log()).size(), 2U);
    EXPECT_EQ(fixture::read_log(log())[1].at("response"), "2");
}

TEST_F(FaultTest, saysThatTheSidecarFindsNoRoomAndGoesOn) {
    fs::create_directories(study());
    if (::mount("tmpfs", study().c_str(), "tmpfs", 0, "size=1m") != 0) {
        GTEST_SKIP() << "only root can mount a small file system";
    }
    begin("[0]");
    wait_for_page();
    // Fill the disk; the log's own block has room for the answer, the sidecar has none to be written anew.
    const auto free = fs::space(study()).available;
    fixture::write(study() / "filling", std::string(free, 'x'));
    run_trial(0, "1"); // with a key that came too early, which the sidecar notes
    try_again();
    EXPECT_TRUE(runs());
    EXPECT_EQ(fixture::read_log(log()).size(), 1U);
    EXPECT_EQ(fixture::read(sidecar()).find("answers before the second"), std::string::npos);
    fs::remove(study() / "filling");
    try_again();
    run_trial(1, "2");
    wait_for_page();
    EXPECT_EQ(fixture::read_log(log()).size(), 2U);
    EXPECT_EQ(nlohmann::json::parse(fixture::read(sidecar()))["Complete"], true);
    ::kill(program_, SIGKILL);
    finish();
    ::umount2(study().c_str(), MNT_DETACH);
}

TEST_F(FaultTest, savesTheAnswerThatWaitsWhenTheExperimenterEndsTheSession) {
    begin("[0, 60]");
    run_trial(0, "1");
    wait_for_page();
    const std::string before = fixture::read(log());
    fixture::append(log(), "x"); // another program's, which the session does not touch
    run_trial(1, "2");
    wait_ms(700);
    fs::resize_file(log(), before.size());
    VirtualScreen::key("ctrl+shift+q");
    EXPECT_EQ(finish().exit_code, 1);
    ASSERT_EQ(fixture::read_log(log()).size(), 2U);
    EXPECT_EQ(fixture::read_log(log())[1].at("response"), "2");
}

TEST_F(FaultTest, printsAnAnswerThatFindsNoPlace) {
    begin("[0, 60]");
    wait_for_page();
    fixture::append(log(), "x");
    run_trial(0, "2");
    wait_ms(700);
    VirtualScreen::key("ctrl+shift+q");
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("an answer was not saved: 1 "), std::string::npos) << outcome.err;
    EXPECT_NE(fixture::read(sidecar()).find("an answer was not saved: 1 "), std::string::npos);
}

TEST_F(FaultTest, saysThatItWaitsForAnotherProgram) {
    fs::create_directories(study());
    const int held = ::open(study().c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    start("[0]", 0.1);
    // The start page is what stays.
    const fs::path png = folder_ / "screen.png";
    std::string shown, before;
    bool page = false;
    for (int look = 0; look < 200 && (!page || shown != before); ++look) {
        before = shown;
        wait_ms(100);
        page = screen_.save(png);
        shown = fixture::read(png);
    }
    // Beyond it there is nothing without the study but the page that says so.
    for (int look = 0; look < 100 && shown == before; ++look) {
        VirtualScreen::key("Return");
        wait_ms(100);
        shown = screen_.save(png) ? fixture::read(png) : before;
    }
    EXPECT_NE(shown, before);
    EXPECT_TRUE(study_files().empty());
    ::close(held);
    leave_instructions();
    ASSERT_FALSE(HasFailure());
    run_trial(0, "1");
    EXPECT_EQ(end_and_read_events().find("another program"), std::string::npos); // nothing failed
    EXPECT_EQ(fixture::read_log(log()).size(), 1U);
}

TEST_F(FaultTest, showsATrialAgainWhenTheMonitorWasUnplugged) {
    // A library stands in for the cable, see refreshing_display.cpp.
    const fs::path cable = folder_ / "cable";
    fixture::write(cable, "");
    ::setenv("LD_PRELOAD", SKIN2AFC_REFRESHING_DISPLAY, 1);
    ::setenv("SKIN2AFC_TEST_CABLE", cable.c_str(), 1);
    start("[0]", 0.1);
    ::unsetenv("LD_PRELOAD");
    ::unsetenv("SKIN2AFC_TEST_CABLE");
    leave_instructions();
    open_trial(0);
    fs::remove(cable);
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground)); // the trial's number again
    fixture::write(cable, "");
    wait_ms(300);
    run_trial(0, "2");
    const std::string events = end_and_read_events();
    EXPECT_NE(events.find("a monitor was unplugged"), std::string::npos) << events;
    EXPECT_NE(events.find("a monitor was plugged in"), std::string::npos) << events;
    EXPECT_NE(events.find("the screen changed; the trial was shown again"), std::string::npos) << events;
    EXPECT_EQ(fixture::read_log(log()).size(), 1U);
}

TEST_F(FaultTest, takesTheDigitsRowOfAnAzertyKeyboard) {
    ASSERT_EQ(std::system("setxkbmap fr"), 0);
    begin("[0]");
    run_trial(0, "eacute"); // where others have 2
    run_trial(1, "ampersand");
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
    ASSERT_EQ(fixture::read_log(log()).size(), 2U);
    EXPECT_EQ(fixture::read_log(log())[0].at("response"), "2");
    EXPECT_EQ(fixture::read_log(log())[1].at("response"), "1");
    VirtualScreen::key("ctrl+shift+q"); // the letter's own key, where others have A
    finish();
}

TEST_F(FaultTest, endsByTheExperimentersKeysOnACyrillicKeyboard) {
    ASSERT_EQ(std::system("setxkbmap ru"), 0);
    begin("[0]");
    wait_ms(500);
    VirtualScreen::key("ctrl+shift+Cyrillic_shorti"); // where others have Q
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("the experimenter ended the session (Ctrl+Shift+Q)"), std::string::npos)
        << outcome.err;
}

} // namespace
