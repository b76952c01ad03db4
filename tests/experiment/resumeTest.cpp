// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <unistd.h>

#include <support/error.h>

#include "log/session_log.h"
#include "resume_fixture.h"

namespace {

namespace fs = std::filesystem;
using fixture::ResumeTest;

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

TEST_F(ResumeTest, takesOffATornLineAfterTheLastAnswer) {
    cut_off_after(12, "13\tts\tno_s");
    nlohmann::ordered_json content = nlohmann::ordered_json::parse(fixture::read(sidecar()));
    content["Complete"] = false;
    fixture::write(sidecar(), content.dump());
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::lines_of(log()).size(), 13U);
    EXPECT_TRUE(fixture::read(log()).ends_with("\n"));
    EXPECT_EQ(facts()["Complete"], true);
    EXPECT_FALSE(fs::exists(log(2)));
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

TEST_F(ResumeTest, goesOnWithARealRunThatKnowsOfNoObservers) {
    // As a run of people has it whose sidecar was written before it named observers.
    cut_off_after(4);
    nlohmann::ordered_json content = nlohmann::ordered_json::parse(fixture::read(sidecar()));
    content.erase("ObserverDigest");
    content["Simulated"] = false;
    fixture::write(sidecar(), content.dump());
    nlohmann::ordered_json study_is =
        nlohmann::ordered_json::parse(fixture::read(study() / "dataset_description.json"));
    study_is["Simulated"] = false;
    fixture::write(study() / "dataset_description.json", study_is.dump());
    auto words = arguments(study(), {"--dry-run"});
    const auto simulate = std::find(words.begin(), words.end(), "--simulate");
    words.erase(simulate, simulate + 2);
    const auto outcome = fixture::run_program(words);
    EXPECT_NE(outcome.err.find("it goes on at trial 5 of 12"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("Digest"), std::string::npos) << outcome.err; // where there is no display
    // A simulated one is another observer.
    EXPECT_EQ(run({"--dry-run"}).exit_code, 2);
}

TEST_F(ResumeTest, saysThatTheClockWasSetBack) {
    cut_off_after(4);
    // What the sidecar holds after the system's clock was set back: a beginning that is still to come.
    nlohmann::ordered_json content = nlohmann::ordered_json::parse(fixture::read(sidecar()));
    content["Parts"][0]["SystemTime"] = content["Parts"][0]["SystemTime"].get<double>() + 1e6;
    fixture::write(sidecar(), content.dump());
    // What the start page says is also what a dry run prints.
    EXPECT_NE(run({"--dry-run"}).out.find("clock was set back by"), std::string::npos);
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_NE(facts()["Events"][0]["Event"].get<std::string>().find("clock was set back"), std::string::npos);
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
}

TEST_F(ResumeTest, refusesASecondSessionOfAParticipant) {
    cut_off_after(4);
    const int held = ::open((study() / "sub-01").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    const auto outcome = run();
    const auto dry = run({"--dry-run"});
    EXPECT_EQ(dry.exit_code, 2);
    EXPECT_NE(dry.err.find("found another session at it"), std::string::npos) << dry.err;
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

} // namespace
