// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>

#include <support/error.h>

#include "fixture.h"
#include "log/session_log.h"

namespace {

namespace fs = std::filesystem;

/// A study of twelve trials, run by the program itself.
class ResumeTest : public testing::Test {
protected:
    ResumeTest() : protocol_(fixture::small_protocol(folder_.path(), "[0, 30, 60, 90, 120, 150]")) {
        fixture::write_stimuli(folder_ / "stimuli", protocol_);
    }

    std::vector<std::string> arguments(const fs::path& study,
                                       const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"session",       protocol_.file.string(),
                                     "--stimuli",     (folder_ / "stimuli").string(),
                                     "--study",       study.string(),
                                     "--participant", "01",
                                     "--simulate",    "null"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    fixture::Outcome run(const std::vector<std::string>& more = {}) const {
        return fixture::run_program(arguments(study(), more));
    }
    fs::path study() const { return folder_ / "study"; }
    fs::path log(int run = 1) const { return fixture::log_path(study(), "01", run); }
    fs::path sidecar() const { return log().replace_extension(".json"); }
    nlohmann::json facts() const { return nlohmann::json::parse(fixture::read(sidecar())); }

    /// Leave the study as a session does that is cut off after so many trials, with `torn` at the log's end.
    void cut_off_after(std::size_t trials, const std::string& torn = "") const {
        ASSERT_EQ(run().exit_code, 0);
        const auto lines = fixture::lines_of(log());
        std::string kept;
        for (std::size_t i = 0; i <= trials; ++i) {
            kept += lines[i] + "\n";
        }
        fixture::write(log(), kept + torn);
    }

    /// What a session decides and a participant answers; times differ between a session and its continuation.
    static std::vector<std::vector<std::string>> answers(const fs::path& log) {
        std::vector<std::vector<std::string>> rows;
        for (const auto& row : fixture::read_log(log)) {
            rows.push_back({row.at("trial"), row.at("first"), row.at("second"), row.at("azimuth_deg"),
                            row.at("response"), row.at("response_time")});
        }
        return rows;
    }

    fixture::TemporaryFolder folder_;
    study::Protocol protocol_;
};

TEST_F(ResumeTest, goesOnInTheSameLogAsIfNothingHadHappened) {
    ASSERT_EQ(run().exit_code, 0);
    const auto whole = answers(log());
    ASSERT_EQ(whole.size(), 12U);
    for (const std::size_t trials : {0U, 1U, 7U, 11U}) {
        fs::remove_all(study());
        cut_off_after(trials);
        const std::string before = fixture::read(log());
        const auto outcome = run();
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(answers(log()), whole);
        EXPECT_EQ(fixture::read(log()).substr(0, before.size()), before);
        EXPECT_EQ(facts()["Complete"], true);
        EXPECT_EQ(facts()["Parts"].size(), 2U);
        EXPECT_EQ(facts()["Parts"][1]["FirstTrial"], trials + 1);
        EXPECT_FALSE(fs::exists(log(2)));
    }
}

TEST_F(ResumeTest, setsATornLineAside) {
    cut_off_after(3, "4\tts\tno_s");
    const auto outcome = run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("its last line was torn"), std::string::npos) << outcome.err;
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
    EXPECT_EQ(facts()["SetAside"], nlohmann::json{"4\tts\tno_s"});
    EXPECT_EQ(fixture::read(log()).find("no_s\n"), std::string::npos);
}

TEST_F(ResumeTest, keepsTheClockRising) {
    cut_off_after(5);
    run();
    double last_s = 0;
    for (const auto& row : fixture::read_log(log())) {
        EXPECT_GT(std::stod(row.at("onset_first")), last_s);
        last_s = std::stod(row.at("onset_second"));
    }
}

TEST_F(ResumeTest, beginsANewRunAfterACompleteOneOrWhenAsked) {
    cut_off_after(5);
    const std::string broken_off = fixture::read(log());
    EXPECT_EQ(run({"--new-run"}).exit_code, 0);
    EXPECT_EQ(fixture::read(log()), broken_off);
    EXPECT_EQ(fixture::read_log(log(2)).size(), 12U);
    const auto again = run();
    EXPECT_NE(again.err.find("run 02 of this participant is complete"), std::string::npos) << again.err;
    EXPECT_EQ(fixture::read_log(log(3)).size(), 12U);
}

TEST_F(ResumeTest, refusesALogEditedByHand) {
    for (const auto& [from, to, expected] :
         {std::tuple{"\t1\t", "\t3\t", "response: expected 1, 2 or n/a, found \"3\""},
          std::tuple{"\n2\t", "\n3\t", "3: trial: expected 2, found \"3\""},
          std::tuple{"trial\t", "trail\t", ":1: expected the columns"},
          std::tuple{"\tnear\t", "\t", "expected"}}) {
        fs::remove_all(study());
        cut_off_after(6);
        std::string text = fixture::read(log());
        ASSERT_NE(text.find(from), std::string::npos);
        text.replace(text.find(from), std::string(from).size(), to);
        fixture::write(log(), text);
        const auto outcome = run();
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("--new-run"), std::string::npos) << outcome.err;
        EXPECT_EQ(fixture::read(log()), text);
    }
}

TEST_F(ResumeTest, keepsAResponseTakenOutByHand) {
    cut_off_after(2);
    std::string text = fixture::read(log());
    const auto rows = fixture::read_log(log());
    const std::string cells = "\t" + rows[1].at("response") + "\t" + rows[1].at("chosen") + "\t";
    text.replace(text.rfind(cells), cells.size(), "\tn/a\tn/a\t");
    fixture::write(log(), text);
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read_log(log())[1].at("response"), "n/a");
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
}

TEST_F(ResumeTest, refusesOtherConditionsThanTheRunBeganWith) {
    cut_off_after(4);
    const std::string before = fixture::read(log());
    const auto expect_refused = [&](const fixture::Outcome& outcome, const std::string& part) {
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(fixture::read(log()), before);
    };
    expect_refused(run({"--seed", "3"}), "Seed: expected the seed that the run began with");

    // A picture rendered anew, with a manifest that vouches for it.
    const std::string manifest = fixture::read(folder_ / "stimuli/manifest.json");
    fixture::write(folder_ / "stimuli/manifest.json", manifest + "\n");
    expect_refused(run(), "StimuliManifestDigest: expected the stimuli that the run began with");
    fixture::write(folder_ / "stimuli/manifest.json", manifest);

    fixture::write(protocol_.file, fixture::read(protocol_.file) + "\n# changed\n");
    expect_refused(run(), "ProtocolDigest: expected the protocol that the run began with");
}

TEST_F(ResumeTest, saysThatTheClockWasSetBack) {
    cut_off_after(4);
    // What the sidecar holds after the system's clock was set back: a beginning that is still to come.
    nlohmann::ordered_json content = nlohmann::ordered_json::parse(fixture::read(sidecar()));
    content["Parts"][0]["SystemTime"] = content["Parts"][0]["SystemTime"].get<double>() + 1e6;
    fixture::write(sidecar(), content.dump());
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_NE(facts()["Events"][0]["Event"].get<std::string>().find("clock was set back"), std::string::npos);
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
}

TEST_F(ResumeTest, refusesASecondSessionOfAParticipant) {
    cut_off_after(4);
    const int held = ::open((study() / "sub-01").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    const auto outcome = run();
    ::close(held);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("found another session at it"), std::string::npos) << outcome.err;
    EXPECT_EQ(fixture::read_log(log()).size(), 4U);
    EXPECT_EQ(run().exit_code, 0);
}

TEST_F(ResumeTest, losesNothingWhereTwoSessionsStartAtOnce) {
    const fixture::TemporaryFolder outputs;
    std::vector<pid_t> programs;
    for (int i = 0; i < 6; ++i) {
        fs::create_directory(outputs / std::to_string(i));
        programs.push_back(fixture::start_program(arguments(study()), outputs / std::to_string(i)));
    }
    int done = 0;
    for (std::size_t i = 0; i < programs.size(); ++i) {
        const int code = fixture::wait_for_program(programs[i], outputs / std::to_string(i)).exit_code;
        EXPECT_TRUE(code == 0 || code == 2) << code;
        done += code == 0 ? 1 : 0;
    }
    ASSERT_GE(done, 1);
    for (int number = 1; number <= done; ++number) {
        EXPECT_EQ(fixture::read_log(log(number)).size(), 12U);
    }
    EXPECT_FALSE(fs::exists(log(done + 1)));
}

TEST_F(ResumeTest, writesADeletedLogAnew) {
    auto session_log = experiment::SessionLog::create(study(), "01");
    const experiment::Answer answer{.trial = {"ts", "no_sss", "near", 0, "ts", "no_sss"}, .response = 1};
    session_log.append(answer);
    fs::remove_all(study());
    EXPECT_THROW(session_log.append(answer), support::Failure);
    session_log.restore();
    session_log.append(answer);
    EXPECT_EQ(fixture::read_log(log()).size(), 2U);
}

/// A file system of its own so small that a log fills it; root alone can have one.
class SmallDisk {
public:
    explicit SmallDisk(const fs::path& folder) : folder_(folder) {
        fs::create_directories(folder);
        mounted_ = ::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=28k") == 0;
    }
    ~SmallDisk() {
        if (mounted_) {
            ::umount2(folder_.c_str(), MNT_DETACH);
        }
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    bool mounted() const { return mounted_; }

private:
    fs::path folder_;
    bool mounted_;
};

TEST_F(ResumeTest, saysThatTheDiskIsFullAndGoesOnWhenItIsNot) {
    const SmallDisk disk(study());
    if (!disk.mounted()) {
        GTEST_SKIP() << "only root can mount a small file system";
    }
    // Fill the disk so far that the session's beginning finds room and its end does not.
    fixture::Outcome outcome;
    for (int kilobytes = 24; kilobytes >= 0; kilobytes -= 4) {
        for (const auto& entry : fs::directory_iterator(study())) {
            fs::remove_all(entry.path());
        }
        fixture::write(study() / "filling", std::string(static_cast<std::size_t>(kilobytes) * 1024, 'x'));
        outcome = run();
        if (fs::exists(log())) {
            break;
        }
        EXPECT_NE(outcome.exit_code, 0);
    }
    if (outcome.exit_code != 0) {
        EXPECT_NE(outcome.err.find("No space left"), std::string::npos) << outcome.err;
    }
    fs::remove(study() / "filling");
    ASSERT_EQ(::mount("tmpfs", study().c_str(), "tmpfs", MS_REMOUNT, "size=1m"), 0);
    if (outcome.exit_code != 0) {
        EXPECT_EQ(run().exit_code, 0);
    }
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
}

/// How many sessions to kill: few by default, more by SKIN2AFC_KILLS.
int kills() {
    const char* count = std::getenv("SKIN2AFC_KILLS");
    return count ? std::atoi(count) : 15;
}

TEST_F(ResumeTest, keepsEveryAnswerOnceHoweverOftenItIsKilled) {
    fixture::write(protocol_.file,
                   fixture::read(protocol_.file) +
                       "practice = 2\n[session.texts]\nconsent = \"Will you?\"\n"
                       "[[session.questions]]\nid = \"age\"\nkind = \"integer\"\ntext = \"Age?\"\n"
                       "[[session.questions]]\nid = \"art\"\nkind = \"text\"\ntext = \"Art?\"\n");
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(fixture::run_program(arguments(folder_ / "undisturbed")).exit_code, 0);
    const auto takes_us = static_cast<unsigned>(
        std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start)
            .count());
    const auto expected = answers(fixture::log_path(folder_ / "undisturbed", "01"));
    std::mt19937 random(7);
    std::set<std::size_t> places;
    int killed = 0;
    int study_number = 0;
    for (; killed < kills(); ++study_number) {
        const fs::path study = folder_ / fmt::format("study{}", study_number);
        const fs::path log = fixture::log_path(study, "01");
        // Kill the session again and again until one reaches its end.
        for (bool done = false; !done;) {
            const pid_t program = fixture::start_program(arguments(study), folder_.path());
            ::usleep(static_cast<useconds_t>(random() % takes_us));
            ::kill(program, SIGKILL);
            const bool survived = fixture::wait_for_program(program, folder_.path()).exit_code == 0;
            killed += survived ? 0 : 1;
            if (fs::exists(log)) {
                const std::string text = fixture::read(log);
                const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
                places.insert(lines - 1);
                done = lines == expected.size() + 1;
            }
            ASSERT_TRUE(done || !survived);
            if (killed >= kills() && !done) {
                ASSERT_EQ(fixture::run_program(arguments(study)).exit_code, 0);
                done = true;
            }
        }
        ASSERT_EQ(answers(log), expected);
        ASSERT_FALSE(fs::exists(fixture::log_path(study, "01", 2)));
        // The questionnaire was answered once, and never again.
        EXPECT_EQ(fixture::lines_of(study / "participants.tsv").size(), 2U);
        EXPECT_EQ(fixture::lines_of(study / "phenotype/questionnaire.tsv").size(), 2U);
        const auto analysed =
            fixture::run_program({"analyse", study.string(), "--out",
                                  (folder_ / fmt::format("analysis{}", study_number)).string()});
        ASSERT_EQ(analysed.exit_code, 0) << analysed.err;
    }
    if (kills() >= 100) {
        // The kills came at different places, or the test has shown nothing.
        EXPECT_GT(places.size(), 6U);
    }
    fmt::print("{} kills in {} sessions, after {} numbers of answers\n", killed, study_number, places.size());
}

} // namespace
