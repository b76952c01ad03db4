// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <chrono>
#include <csignal>
#include <ctime>
#include <set>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "fixture.h"
#include "schedule.h"
#include "virtual_screen.h"

namespace {

namespace fs = std::filesystem;
using fixture::VirtualScreen;

// The published study's screen, section 5.2.
constexpr int width = 1650, height = 988;
constexpr std::array<std::uint8_t, 3> page_ground{38, 38, 38}; // 15 % of 255

constexpr const char* session_texts = R"(
practice = 1
pause_every = 1
[session.texts]
consent = "Мы изучаем, как выглядит кожа.\n\n私たちは肌の見え方を研究しています。\n\nΘέλετε;"
agree = "Да"
decline = "Нет"
declined = "Danke. Nichts wurde gespeichert."
[[session.questions]]
id = "age"
kind = "integer"
text = "Wie alt sind Sie?"
least = 18
most = 120
[[session.questions]]
id = "sex"
kind = "choice"
text = "Geschlecht?"
choices = ["weiblich", "männlich"]
values = ["female", "male"]
[[session.questions]]
id = "art"
kind = "multiple"
text = "Was üben Sie aus?"
choices = ["Zeichnen", "Fotografie", "Grafik"]
values = ["drawing", "photography", "graphics"]
[[session.questions]]
id = "remark"
kind = "text"
text = "Sonst noch etwas?"
optional = true
)";

/// A session with everything that a participant meets, on a screen of the published size, by real keys.
class WholeSessionTest : public testing::Test {
protected:
    WholeSessionTest() {
        const std::string toml = "name = \"whole\"\nshaders = [\"no_sss\", \"ts\"]\n"
                                 "[image]\nwidth = 1650\nheight = 988\n"
                                 "[camera]\ndistances = [{ name = \"near\", units = 50 }]\n"
                                 "[light]\nazimuths_deg = [0]\n[session]\ngrey_s = 0.3\n";
        fixture::write(folder_ / "whole.toml", toml + session_texts);
        protocol_ = study::read_protocol(folder_ / "whole.toml");
        fixture::write_stimuli(folder_ / "stimuli", protocol_);
    }
    /// Make the consent longer than the screen.
    void write_long_consent() {
        std::string toml = fixture::read(protocol_.file), paragraphs;
        for (int i = 1; i <= 14; ++i) {
            paragraphs +=
                fmt::format("{}. We study how skin looks, and this sentence is so long that it is broken "
                            "where the line ends, wherever that may be.\\n\\n",
                            i);
        }
        const std::string name = "consent = \"";
        toml.insert(toml.find(name) + name.size(), paragraphs);
        fixture::write(protocol_.file, toml);
    }
    ~WholeSessionTest() override {
        // What was on each screen is worth a look where something went wrong.
        if (HasFailure()) {
            const fs::path kept = fs::temp_directory_path() / "skin2afc-screens";
            fs::remove_all(kept);
            fs::copy(folder_ / "screens", kept, fs::copy_options::recursive);
            fmt::print("the screens are kept in {}\n", kept.string());
        }
        if (program_ > 0) {
            ::kill(program_, SIGKILL);
            ::waitpid(program_, nullptr, 0);
        }
    }

    void start() {
        program_ = fixture::start_program(
            {"session", protocol_.file.string(), "--stimuli", (folder_ / "stimuli").string(), "--study",
             study().string(), "--participant", "01", "--frames", (folder_ / "frames.tsv").string()},
            folder_.path());
    }
    /// Start, and go on from the start page to the consent.
    void open_consent() {
        start();
        ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
        settle("start");
        key("Return");
        settle("consent");
    }
    fixture::Outcome finish() {
        const auto outcome = fixture::wait_for_program(program_, folder_.path());
        program_ = -1;
        return outcome;
    }
    fs::path study() const { return folder_ / "study"; }
    fs::path log() const { return fixture::log_path(study(), "01"); }
    nlohmann::json sidecar() const {
        return nlohmann::json::parse(fixture::read(fs::path(log()).replace_extension(".json")));
    }

    /// Keep the screen that is there when it stays the same for a while, under a name.
    void settle(const std::string& name) {
        if (HasFailure()) {
            return; // what comes is not what is expected
        }
        fs::create_directories(folder_ / "screens");
        const fs::path png = folder_ / fs::path("screens") / fmt::format("{:02d}_{}.png", ++screens_, name);
        std::string before;
        for (int look = 0; look < 200; ++look) {
            const bool shows_something = screen_.save(png); // an empty page comes while pictures are loaded
            const std::string now = fixture::read(png);
            if (shows_something && now == before && now != last_screen_) {
                last_screen_ = now;
                return;
            }
            before = now;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        FAIL() << "the screen " << name << " did not come";
    }
    /// Whether a choice is lit, anywhere down the middle of the column.
    bool shows_a_choice() const {
        constexpr std::array<std::uint8_t, 3> lit{64, 107, 140}; // 25, 42 and 55 % of 255
        for (int y = 0; y < height; ++y) {
            if (screen_.pixel(1000, y) == lit) {
                return true;
            }
        }
        return false;
    }
    void key(const std::string& name) const { VirtualScreen::key(name); }

    fixture::TemporaryFolder folder_;
    VirtualScreen screen_{folder_.path(), width, height};
    study::Protocol protocol_;
    std::string last_screen_;
    int screens_ = 0;
    pid_t program_ = -1;
};

TEST_F(WholeSessionTest, leadsAParticipantFromTheConsentToTheEnd) {
    open_consent();
    EXPECT_TRUE(fixture::files_below(study()).empty()); // nothing is written before consent
    key("Escape");
    key("Return"); // no answer yet: said so, and nothing else
    settle("consent_missing");
    key("1");
    settle("consent_given");
    key("Return");
    settle("age");
    // The time of the consent is that of the agreement, not of what comes seconds later.
    const std::string agreed = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    VirtualScreen::act({"type", "17"});
    settle("age_typed");
    key("Return"); // below the least
    settle("age_missing");
    key("BackSpace");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    VirtualScreen::act({"type", "01"}); // 1 and 01
    settle("age_wrong");
    key("Return");
    settle("sex");
    key("KP_1");
    settle("sex_given");
    key("Return");
    settle("art");
    key("3");
    key("1");
    settle("art_given");
    key("Prior"); // Page Up
    settle("sex_again");
    key("Return");
    settle("art_again");
    key("Return");
    settle("remark");
    key("Return");
    settle("instructions");
    for (const char* part : {"practice", "trial1", "trial2"}) {
        key("space");
        settle(fmt::format("{}_number", part));
        if (std::string(part) == "trial1") {
            key("Escape"); // does nothing
        }
        key("space");
        settle(fmt::format("{}_first", part));
        if (std::string(part) == "trial1") {
            key("2"); // too early
        }
        key("space");
        std::this_thread::sleep_for(std::chrono::milliseconds(1000));
        settle(fmt::format("{}_second", part));
        key("2");
        settle(fmt::format("{}_after", part));
    }
    ASSERT_FALSE(HasFailure()); // a session on another screen than expected would never end
    key("space");
    const auto outcome = finish();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

    // 1, then 01: a hundred and one, which is written as 89.
    EXPECT_EQ(fixture::read(study() / "participants.tsv"), "participant_id\tage\tsex\nsub-01\t89\tfemale\n");
    EXPECT_EQ(fixture::read(study() / "phenotype/questionnaire.tsv"),
              "participant_id\tart\tremark\nsub-01\tdrawing;graphics\tn/a\n");
    const auto rows = fixture::read_log(log());
    ASSERT_EQ(rows.size(), 2U); // practice is not there
    EXPECT_EQ(rows[0].at("response"), "2");
    EXPECT_EQ(sidecar()["Complete"], true);
    EXPECT_NE(sidecar()["Consent"], "n/a");
    EXPECT_LE(sidecar()["Consent"].get<std::string>(), agreed);
    EXPECT_NE(sidecar()["Events"].dump().find("answers before the second picture, ignored: 1"),
              std::string::npos);
    // Every picture's times: three a trial, practice included.
    const auto frames = fixture::read_log(folder_ / "frames.tsv");
    EXPECT_EQ(std::count_if(frames.begin(), frames.end(),
                            [](const auto& row) { return row.at("picture") == "grey"; }),
              3);
}

TEST_F(WholeSessionTest, letsAParticipantDeclineUnread) {
    write_long_consent();
    open_consent();
    key("2");
    settle("consent_declined");
    key("Return");
    settle("declined");
    EXPECT_TRUE(fixture::files_below(study()).empty());
}

TEST_F(WholeSessionTest, takesNoConsentToATextThatWasNotSeenToItsEnd) {
    write_long_consent();
    open_consent();
    key("1");
    settle("consent_chosen");
    key("Return");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_TRUE(shows_a_choice());
    VirtualScreen::key_down("Down");
    std::this_thread::sleep_for(std::chrono::milliseconds(6000));
    VirtualScreen::key_up("Down");
    settle("consent_end");
    key("Return");
    settle("age");
    EXPECT_FALSE(shows_a_choice());
    EXPECT_TRUE(fixture::files_below(study()).empty());
}

TEST_F(WholeSessionTest, scrollsByEachQuickPress) {
    write_long_consent();
    open_consent();
    // Two lines a press; the text has some forty below the screen's end.
    VirtualScreen::act({"key", "--repeat", "30", "--delay", "1", "Down"});
    settle("consent_end");
    key("1");
    settle("consent_chosen");
    EXPECT_TRUE(shows_a_choice());
    key("Return");
    settle("age");
    EXPECT_FALSE(shows_a_choice());
}

TEST_F(WholeSessionTest, endsPolitelyWithoutConsent) {
    open_consent();
    key("2");
    settle("declined_choice");
    key("Return");
    settle("declined");
    ASSERT_FALSE(HasFailure());
    // Another window's size is no reason to end another way.
    VirtualScreen::act({"search", "--name", "^skin2afc$", "windowsize", "1700", "1000"});
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    key("space");
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("did not agree to take part; nothing was written"), std::string::npos)
        << outcome.err;
    EXPECT_FALSE(fs::exists(study()));
}

TEST_F(WholeSessionTest, endsByTheKeysThatTheProtocolNames) {
    start();
    ASSERT_TRUE(screen_.becomes(1, 1, page_ground));
    settle("start");
    VirtualScreen::act({"search", "--name", "^skin2afc$", "windowsize", "800", "600"});
    VirtualScreen::act({"search", "--name", "^skin2afc$", "windowsize", "1650", "988"});
    key("ctrl+shift+q");
    const auto outcome = finish();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("the experimenter ended the session (Ctrl+Shift+Q)"), std::string::npos)
        << outcome.err;
    EXPECT_FALSE(fs::exists(study()));
}

} // namespace
