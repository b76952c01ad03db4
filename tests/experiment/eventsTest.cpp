// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <unistd.h>

#include "resume_fixture.h"

namespace {

namespace fs = std::filesystem;
using fixture::ResumeTest;

fs::path events_of(const fs::path& log) {
    std::string name = log.filename().string();
    name.replace(name.find("_beh"), 4, "_events");
    return log.parent_path() / name;
}

TEST_F(ResumeTest, listsEachPictureAsAnEventWithItsFile) {
    ASSERT_EQ(run().exit_code, 0);
    const auto answers = fixture::read_log(log());
    const auto events = fixture::read_log(events_of(log()));
    ASSERT_EQ(events.size(), 3 * answers.size());
    constexpr double rounding_s = 2e-6; // of times written to the microsecond
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const auto& answer = answers[i];
        const auto number = [](const fixture::Row& row, const char* key) { return std::stod(row.at(key)); };
        const auto &first = events[3 * i], &grey = events[3 * i + 1], &second = events[3 * i + 2];
        EXPECT_EQ(first.at("trial"), answer.at("trial"));
        EXPECT_EQ(first.at("onset"), answer.at("onset_first"));
        EXPECT_EQ(second.at("onset"), answer.at("onset_second"));
        EXPECT_EQ(second.at("duration"), answer.at("response_time"));
        EXPECT_EQ(grey.at("stim_file"), "n/a");
        // What ends begins the next.
        EXPECT_NEAR(number(first, "onset") + number(first, "duration"), number(grey, "onset"), rounding_s);
        EXPECT_NEAR(number(grey, "onset") + number(grey, "duration"), number(second, "onset"), rounding_s);
        for (const auto& [event, shader] : {std::pair{first, "first"}, std::pair{second, "second"}}) {
            EXPECT_EQ(event.at("trial_type"), shader);
            const fs::path kept = study() / "stimuli" / event.at("stim_file");
            const auto picture =
                study::stimulus_name(answer.at(shader), "near", std::stoi(answer.at("azimuth_deg")));
            EXPECT_EQ(fixture::read(kept), fixture::read(folder_ / "stimuli" / (picture + ".png"))) << kept;
        }
    }
}

TEST_F(ResumeTest, namesNoFileOfWhichTheStudyHasNoCopy) {
    // A file in the copies' place: they cannot be made, and the session runs.
    fixture::write(study() / "stimuli", "");
    const auto outcome = run();
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("note: "), std::string::npos) << outcome.err;
    for (const auto& event : fixture::read_log(events_of(log()))) {
        EXPECT_EQ(event.at("stim_file"), "n/a");
    }
}

TEST_F(ResumeTest, keepsTheStimuliOfEachSetApart) {
    ASSERT_EQ(run().exit_code, 0);
    const std::string manifest = fixture::read(folder_ / "stimuli/manifest.json");
    fixture::write(folder_ / "stimuli/manifest.json", manifest + "\n");
    ASSERT_EQ(run().exit_code, 0);
    const auto folder_in = [&](int run) {
        return fs::path(fixture::read_log(events_of(log(run)))[0].at("stim_file")).parent_path();
    };
    EXPECT_NE(folder_in(1), folder_in(2));
}

TEST_F(ResumeTest, listsTheEventsOfAllPartsOfARun) {
    cut_off_after(5);
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read_log(events_of(log())).size(), 36U);
}

TEST_F(ResumeTest, knowsNoTimeThatIsNotInTheLog) {
    cut_off_after(3);
    auto lines = fixture::lines_of(log());
    const auto row = fixture::read_log(log())[0];
    const std::string from = "\t" + row.at("onset_grey") + "\t";
    lines[1].replace(lines[1].find(from), from.size(), "\tn/a\t");
    fixture::write(log(), lines[0] + "\n" + lines[1] + "\n");
    ASSERT_EQ(run().exit_code, 0);
    const auto events = fixture::read_log(events_of(log()));
    EXPECT_EQ(events[0].at("duration"), "n/a");
    EXPECT_EQ(events[1].at("onset"), "n/a");
    EXPECT_EQ(events[1].at("duration"), "n/a");
    EXPECT_EQ(events[2].at("onset"), row.at("onset_second"));
}

TEST_F(ResumeTest, leavesEventsAloneWhoseColumnsWereChanged) {
    cut_off_after(3);
    fixture::write(events_of(log()), "onset\tduration\tgaze\n1\t2\tleft\n");
    const auto outcome = run();
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("has other columns than the program's"), std::string::npos) << outcome.err;
    EXPECT_EQ(fixture::read(events_of(log())), "onset\tduration\tgaze\n1\t2\tleft\n");
    EXPECT_EQ(facts()["Complete"], true);
}

TEST_F(ResumeTest, copiesAPictureAnewWhoseCopyWasChanged) {
    ASSERT_EQ(run().exit_code, 0);
    const auto kept = study() / "stimuli" / fixture::read_log(events_of(log()))[0].at("stim_file");
    const std::string picture = fixture::read(kept);
    fixture::write(kept, "another");
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read(kept), picture);
}

TEST_F(ResumeTest, leavesACopyThatAnotherProgramIsAt) {
    fixture::write(study() / "stimuli/.contact_sheet.99.pending.png", "half");
    const int copying = ::open((study() / "stimuli").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(copying, LOCK_SH), 0);
    EXPECT_EQ(run().exit_code, 0);
    ::close(copying);
    EXPECT_EQ(fixture::read(study() / "stimuli/.contact_sheet.99.pending.png"), "half");
    EXPECT_NE(fixture::read_log(events_of(log()))[0].at("stim_file"), "n/a"); // both may copy at once
}

TEST_F(ResumeTest, removesWhatAKilledProgramLeft) {
    for (const char* left :
         {".participants.99.pending.tsv", ".probe.99", "sub-01/beh/.x.99.pending",
          "phenotype/.questionnaire.99.pending.json", "stimuli/.contact_sheet.99.pending.png",
          "stimuli/0123456789ab/.ts_near_000.99.pending.png", "stimuli/0123456789ab/.probe.99"}) {
        fixture::write(study() / left, "half");
    }
    fixture::write(study() / ".bidsignore", "extra");
    const fs::path others = study() / "stimuli" / "others" / ".x.99.pending.png";
    fixture::write(others, "of another program");
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_TRUE(fs::remove(others)) << "not in a folder of copies";
    const auto files = fixture::files_below(study());
    EXPECT_TRUE(std::none_of(files.begin(), files.end(), [](const std::string& file) {
        return file.find("pending") != std::string::npos || file.find("probe") != std::string::npos;
    }));
    EXPECT_EQ(fixture::read(study() / ".bidsignore"), "extra");
}

TEST_F(ResumeTest, takesTheCopiesThatAreThereWhereNoneCanBeMade) {
    ASSERT_EQ(run().exit_code, 0);
    const int held = ::open((study() / "stimuli").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(::flock(held, LOCK_EX), 0);
    auto words = arguments(study());
    *(std::find(words.begin(), words.end(), "--participant") + 1) = "02";
    ASSERT_EQ(fixture::run_program(words).exit_code, 0);
    ::close(held);
    const auto events = fixture::read_log(events_of(fixture::log_path(study(), "02")));
    ASSERT_FALSE(events.empty());
    for (const auto& event : events) {
        EXPECT_EQ(event.at("stim_file") == "n/a", event.at("trial_type") == "grey");
    }
}

TEST_F(ResumeTest, needsNoReadmeThatItCanRead) {
    fs::create_directories(study() / "README.md");
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_TRUE(fs::is_directory(study() / "README.md"));
    EXPECT_FALSE(fixture::read_log(log()).empty());
}

TEST_F(ResumeTest, knowsAnObserverByItsContent) {
    const auto run_as = [&](const char* name) {
        auto words = arguments(study());
        *(std::find(words.begin(), words.end(), "--simulate") + 1) = (folder_ / name).string();
        return fixture::run_program(words);
    };
    fixture::write(folder_ / "a.toml", "default = 0.9\n");
    fixture::write(folder_ / "b.toml", "default = 0.8\n");
    fixture::write(folder_ / "c.toml", "default = 0.9\n");
    ASSERT_EQ(run_as("a.toml").exit_code, 0);
    const auto lines = fixture::lines_of(log());
    fixture::write(log(), lines[0] + "\n" + lines[1] + "\n");
    const auto other = run_as("b.toml");
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("ObserverDigest: expected the observer that the run began with"),
              std::string::npos)
        << other.err;
    EXPECT_EQ(run_as("c.toml").exit_code, 0);
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
}

TEST_F(ResumeTest, leavesAnswersTheRoomThatStimuliWouldTake) {
    fs::create_directories(study());
    if (::mount("tmpfs", study().c_str(), "tmpfs", 0, "size=8m") != 0) {
        GTEST_SKIP() << "only root can mount a small file system";
    }
    EXPECT_NE(run({"--dry-run"}).out.find("warning: " + study().string() + ": its disk has only 8 MB left"),
              std::string::npos);
    const auto outcome = run();
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("has no room for a copy of the stimuli"), std::string::npos) << outcome.err;
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
    ::umount2(study().c_str(), MNT_DETACH);
}

} // namespace
