// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "log/session_log.h"
#include "resume_fixture.h"

namespace {

namespace fs = std::filesystem;
using fixture::ResumeTest;

TEST_F(ResumeTest, refusesALogWithoutHeader) {
    cut_off_after(3);
    const std::string header = fixture::lines_of(log()).front();
    for (const std::string& left : {std::string(), header.substr(0, 20), header}) {
        fixture::write(log(), left);
        const auto outcome = run();
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find("beh.tsv:1: expected"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("--new-run"), std::string::npos) << outcome.err;
        EXPECT_EQ(fixture::read(log()), left);
    }
}

TEST_F(ResumeTest, keepsALastAnswerWhoseLineHasNoEnd) {
    cut_off_after(5);
    const std::string before = fixture::read(log());
    fixture::write(log(), before.substr(0, before.size() - 1));
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read(log()).substr(0, before.size()), before);
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
    EXPECT_TRUE(facts()["SetAside"].empty());
}

TEST_F(ResumeTest, leavesACompleteRunAloneWhoseLastLineHasNoEnd) {
    ASSERT_EQ(run().exit_code, 0);
    const std::string whole = fixture::read(log());
    fixture::write(log(), whole.substr(0, whole.size() - 1));
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read(log()), whole.substr(0, whole.size() - 1));
    EXPECT_EQ(fixture::read_log(log(2)).size(), 12U);
}

// A number that was being written lacks decimals: the answer would be kept with a wrong time.
TEST_F(ResumeTest, asksAgainWhereTheLastNumberIsTorn) {
    cut_off_after(5);
    const std::string before = fixture::read(log());
    fixture::write(log(), before.substr(0, before.size() - 2));
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(facts()["SetAside"].size(), 1U);
    EXPECT_EQ(facts()["Parts"][1]["FirstTrial"], 5);
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
}

TEST_F(ResumeTest, leavesATornLineUntilItIsToldTo) {
    cut_off_after(2, "3\tts");
    const std::string torn = fixture::read(log());
    auto session_log = experiment::SessionLog::resume(log(), experiment::read_log(log()));
    EXPECT_EQ(fixture::read(log()), torn);
    session_log.settle();
    EXPECT_EQ(fixture::read(log()), torn.substr(0, torn.size() - 4));
}

TEST_F(ResumeTest, endsARunThatWasKilledAfterItsLastAnswer) {
    ASSERT_EQ(run().exit_code, 0);
    const std::string whole = fixture::read(log());
    // What a kill between the last answer and the end leaves.
    nlohmann::ordered_json content = nlohmann::ordered_json::parse(fixture::read(sidecar()));
    content["Complete"] = false;
    fixture::write(sidecar(), content.dump());
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read(log()), whole);
    EXPECT_EQ(facts()["Complete"], true);
    EXPECT_FALSE(fs::exists(log(2)));
}

TEST_F(ResumeTest, refusesASidecarEditedByHand) {
    cut_off_after(4);
    const std::string before = fixture::read(sidecar());
    for (const char* key : {"Parts", "Events", "SetAside", "Warnings", "TrialsPlanned", "Simulated"}) {
        auto content = nlohmann::ordered_json::parse(before);
        content[key] = "x";
        fixture::write(sidecar(), content.dump());
        const auto outcome = run();
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find(std::string("beh.json: ") + key + ": expected"), std::string::npos)
            << outcome.err;
    }
}

TEST_F(ResumeTest, findsInADryRunThatTheStudyCannotBeWritten) {
    fixture::write(folder_ / "file", "");
    const auto outcome = fixture::run_program(arguments(folder_ / "file" / "study", {"--dry-run"}));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("expected a folder that can be written"), std::string::npos) << outcome.err;
}

TEST_F(ResumeTest, findsAFrameTableThatCannotBeWrittenBeforeTheStart) {
    const auto outcome = run({"--frames", (folder_ / "none" / "frames.tsv").string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("--frames"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(log()));
}

TEST_F(ResumeTest, goesOnInItsFrameTable) {
    cut_off_after(4);
    const std::string frames = (folder_ / "frames.tsv").string();
    EXPECT_EQ(run({"--frames", frames}).exit_code, 0);
    const std::string table = fixture::read(frames);
    EXPECT_EQ(run({"--frames", frames}).exit_code, 2); // a run of its own
    EXPECT_EQ(fixture::read(frames), table);
    fs::remove_all(study());
    cut_off_after(4);
    EXPECT_EQ(run({"--frames", frames}).exit_code, 0);
    EXPECT_EQ(fixture::read(frames).substr(0, table.size()), table);
}

TEST_F(ResumeTest, refusesTheFrameTableOfAnotherRun) {
    cut_off_after(4);
    const fs::path frames = folder_ / "frames.tsv";
    const std::string columns = "trial\tpicture\tasked\tswap_began\tonset\tmissed_frames\tpart\tframe\trun\n";
    const std::string others = columns + "1\tpage\t0\t0\t0\t0\t1\t1\tsub-02_run-01\n";
    fixture::write(frames, others);
    const auto outcome = run({"--frames", frames.string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("or the table of the run, found a file"), std::string::npos) << outcome.err;
    EXPECT_EQ(fixture::read(frames), others);
    fixture::write(frames, columns + "1\tpage\t0\t0\t0\t0\t1\t1\tsub-01_run-01\n");
    EXPECT_EQ(run({"--frames", frames.string()}).exit_code, 0);
}

TEST_F(ResumeTest, notesRunsUnderAnotherVersionOfTheProtocol) {
    ASSERT_EQ(run().exit_code, 0);
    EXPECT_EQ(run({"--dry-run"}).out.find("another version"), std::string::npos);
    fixture::append(protocol_.file, "\n# changed\n");
    EXPECT_NE(run({"--dry-run"}).out.find("runs of this study under another version of the protocol: 1"),
              std::string::npos);
}

TEST_F(ResumeTest, runsWhereTheContactSheetCannotBeKept) {
    fixture::write(folder_ / "stimuli/contact_sheet.png", "picture");
    fs::create_directory(study());
    fixture::write(study() / "stimuli", "a file in the folder's place");
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(fixture::read_log(log()).size(), 12U);
}

// A log that another program has emptied takes no answer without the ones before.
TEST_F(ResumeTest, writesALogAnewThatWasMovedAndRefusesAChangedOne) {
    auto session_log = experiment::SessionLog::create(study(), "01");
    const experiment::Answer answer{.trial = {"ts", "no_sss", "near", 0, "ts", "no_sss"}, .response = 1};
    session_log.append(answer);
    const std::string before = fixture::read(log());
    fs::rename(study(), folder_ / "moved");
    EXPECT_THROW(session_log.append(answer), std::runtime_error);
    EXPECT_EQ(fixture::read(fixture::log_path(folder_ / "moved", "01")), before);
    session_log.restore();
    EXPECT_EQ(fixture::read(log()), before);
    fixture::write(log(), "");
    EXPECT_THROW(session_log.append(answer), std::runtime_error);
    fs::remove(log());
    session_log.restore();
    session_log.append(answer);
    EXPECT_EQ(fixture::read_log(log()).size(), 2U);
}

} // namespace
