// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/study.h>

#include <gtest/gtest.h>

#include <support/error.h>

#include "study_folder.h"

namespace {

using stats::read_study;
using stats::Study;

std::string error_of(const StudyFolder& folder) {
    return message_of<support::InputError>([&] { read_study(folder.path()); });
}

void expect_error(const StudyFolder& folder, const std::string& part) {
    EXPECT_NE(error_of(folder).find(part), std::string::npos) << error_of(folder);
}

/// "01:2" for each run that counts: participant and run.
std::string used_runs(const Study& study) {
    std::string text;
    for (const stats::Run& run : study.runs) {
        text += run.used ? fmt::format("{}:{} ", run.participant, run.number) : "";
    }
    return text;
}

TEST(StudyTest, readsBareLogsWithoutSidecarsOrDescription) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtn"));
    folder.write_log("A+2", log_text("rrr"));
    const Study study = read_study(folder.path());
    EXPECT_EQ(study.name, folder.path().filename().string());
    EXPECT_FALSE(is_simulated(study));
    const auto found = contents(study);
    EXPECT_EQ(found.participants, 2u);
    EXPECT_EQ(found.trials, 6u);
    EXPECT_EQ(found.unanswered, 1u);
    EXPECT_EQ(study.runs.front().file, "sub-01/beh/sub-01_task-skin2afc_beh.tsv");
}

TEST(StudyTest, theLastCompleteRunCounts) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rr"));
    folder.write_log("01", log_text("tt"), "_run-2");
    folder.write_log("01", log_text("r"), "_run-10"); // after run 2, though its name sorts before
    const Study study = read_study(folder.path());
    EXPECT_EQ(used_runs(study), "01:2 ");
    EXPECT_EQ(study.runs[0].why_left_out, "complete, but a later complete run counts");
    EXPECT_EQ(study.runs[2].why_left_out, "incomplete, 1 of 2 trials; run 2 counts");
}

TEST(StudyTest, withoutACompleteRunTheLastThatHoldsTrialsCounts) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rrr")); // the study's longest log: complete means 3 trials
    folder.write_log("02", log_text("rr"));
    folder.write_log("02", log_text("t"), "_run-02");
    folder.write_log("02", log_header, "_run-03");
    const Study study = read_study(folder.path());
    EXPECT_EQ(used_runs(study), "01:1 02:2 ");
    EXPECT_FALSE(study.runs[2].complete);
    EXPECT_EQ(study.runs[3].why_left_out, "no trials");
}

TEST(StudyTest, theSidecarSaysWhatIsComplete) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rr"));
    folder.write_sidecar("01", R"({"TrialsPlanned": 2})");
    folder.write_log("01", log_text("ttt"), "_run-02");
    folder.write_sidecar("01", R"({"TrialsPlanned": 4})", "_run-02");
    EXPECT_EQ(used_runs(read_study(folder.path())), "01:1 ");
}

TEST(StudyTest, aTornLineDoesNotCompleteARun) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rr"));
    const std::string text = log_text("tt");
    folder.write_log("01", text.substr(0, text.size() - 1), "_run-02");
    EXPECT_EQ(used_runs(read_study(folder.path())), "01:1 ");
}

TEST(StudyTest, aParticipantWithoutTrialsCountsNothing) {
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    folder.write_log("02", log_header);
    fs::create_directories(folder.path() / "sub-03" / "beh");
    const Study study = read_study(folder.path());
    EXPECT_EQ(contents(study).participants, 1u);
    EXPECT_EQ(study.participants_without_log, std::vector<std::string>{"03"});
}

TEST(StudyTest, simulatedDataSaySo) {
    const StudyFolder described, marked;
    described.write_log("01", log_text("r"));
    described.write("dataset_description.json", R"({"Name": "A study", "Simulated": true})");
    EXPECT_TRUE(is_simulated(read_study(described.path())));
    EXPECT_EQ(read_study(described.path()).name, "A study");
    EXPECT_EQ(contents(read_study(described.path())).simulated_runs, 1u);

    marked.write_log("01", log_text("r"));
    marked.write_log("02", log_text("r"));
    marked.write_sidecar("02", R"({"Simulated": true})");
    EXPECT_TRUE(is_simulated(read_study(marked.path())));
    EXPECT_EQ(contents(read_study(marked.path())).simulated_runs, 1u);
}

TEST(StudyTest, otherFilesAreNotRead) {
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    folder.write("participants.tsv", "rubbish");
    folder.write("sub-01/beh/sub-01_task-other_beh.tsv", "rubbish");
    folder.write("sub-01/beh/.sub-01_task-skin2afc_run-02_beh.tsv", "rubbish");
    folder.write("sub-01/anat/x.txt", "rubbish");
    EXPECT_EQ(read_study(folder.path()).runs.size(), 1u);
}

TEST(StudyTest, aStudyWithoutAnswersIsRefused) {
    const StudyFolder empty, unanswered;
    expect_error(empty, "expected logs sub-<label>/beh/");
    unanswered.write_log("01", log_text("nn"));
    expect_error(unanswered, "expected at least one answer");
    EXPECT_NE(
        message_of<support::InputError>([&] { read_study(empty.path() / "missing"); }).find("found nothing"),
        std::string::npos);
    const fs::path file = empty.write("file", "x");
    EXPECT_NE(message_of<support::InputError>([&] { read_study(file); }).find("found a file"),
              std::string::npos);
}

TEST(StudyTest, namesThatBidsDoesNotAllowAreRefused) {
    const StudyFolder label, run, other;
    label.write_log("a_b", log_text("r"));
    expect_error(label, "letters, digits and +");
    for (const char* entity :
         {"_run-", "_run-x", "_run--1", "_run-1x", "_ses-1", "_run-99999999999999999999"}) {
        const StudyFolder folder;
        folder.write_log("01", log_text("r"), entity);
        expect_error(folder, "[_run-<number>]");
    }
    other.write("sub-01/beh/sub-02_task-skin2afc_beh.tsv", log_text("r"));
    expect_error(other, "expected the name sub-01_task-skin2afc");
}

TEST(StudyTest, badSidecarsNameFileAndField) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "expected JSON"},
        {"{\"TrialsPlanned\": 2", "expected JSON"},
        {"[]", "expected a JSON object, found array"},
        {R"({"TrialsPlanned": "72"})", "TrialsPlanned: expected a whole number from 1 on, found \"72\""},
        {R"({"TrialsPlanned": 1.5})", "found 1.5"},
        {R"({"TrialsPlanned": 0})", "found 0"},
        {R"({"TrialsPlanned": -3})", "found -3"},
        {R"({"TrialsPlanned": 18446744073709551615})", "TrialsPlanned"},
        {R"({"TrialsPlanned": [[2]]})", "found array"},
        {R"({"DroppedFrames": -1})", "DroppedFrames: expected a whole number from 0 on, found -1"},
        {R"({"DroppedFrames": 9223372036854775807})",
         "DroppedFrames: expected a whole number from 0 on and at most"},
        {R"({"ProtocolDigest": 7})", "ProtocolDigest: expected a text, found 7"},
        {R"({"Simulated": "no"})", "Simulated: expected true or false, found \"no\""},
    };
    for (const auto& [json, part] : cases) {
        const StudyFolder folder;
        folder.write_log("01", log_text("r"));
        folder.write_sidecar("01", json);
        expect_error(folder, part);
        expect_error(folder, "sub-01_task-skin2afc_beh.json");
        EXPECT_EQ(error_of(folder).find("json.exception"), std::string::npos);
    }
}

TEST(StudyTest, deepJsonIsRefusedWithoutHarm) {
    // A million nested arrays would overflow the stack of anything that descends into them.
    const StudyFolder folder;
    folder.write_log("01", log_text("r"));
    folder.write_sidecar("01", "{\"Simulated\": " + std::string(1'000'000, '[') +
                                   std::string(1'000'000, ']') + "}");
    expect_error(folder, "Simulated: expected true or false, found array");
}

TEST(StudyTest, badFilesRefuseTheStudyUnlessTheyAreLeftOut) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    folder.write_log("02", "trial,reference,test\n");
    folder.write_log("03", log_text("r") + "2\tts\n" + log_line(3, 'r'));
    expect_error(
        folder,
        "sub-02_task-skin2afc_beh.tsv:1: expected columns separated by tabs, found commas (1 more bad "
        "file; --skip-bad leaves them out)");
    const Study study = read_study(folder.path(), {true, false});
    EXPECT_EQ(used_runs(study), "01:1 ");
    ASSERT_EQ(study.bad_files.size(), 2u);
    EXPECT_EQ(study.bad_files[1].file, "sub-03/beh/sub-03_task-skin2afc_beh.tsv");
    EXPECT_NE(study.bad_files[1].why.find("sub-03_task-skin2afc_beh.tsv:3: expected 13 fields"),
              std::string::npos);
}

TEST(StudyTest, aGoodRunCountsBesideABadOne) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rt"));
    folder.write_log("01", log_text("rt"), "_run-02");
    folder.write_sidecar("01", "[]", "_run-02");
    EXPECT_EQ(used_runs(read_study(folder.path(), {true, false})), "01:1 ");
    const StudyFolder only_bad;
    only_bad.write_log("01", "");
    EXPECT_NE(message_of<support::InputError>([&] {
                  read_study(only_bad.path(), {true, false});
              }).find("found none that can be read"),
              std::string::npos);
}

TEST(StudyTest, runsOfAnotherProtocolAreNotMixedIn) {
    const StudyFolder folder;
    for (const auto& [label, digest] : {std::pair("01", "aa"), {"02", "bb"}, {"03", "aa"}}) {
        folder.write_log(label, log_text("rt"));
        folder.write_sidecar(label, fmt::format(R"({{"Protocol": "p", "ProtocolDigest": "{}"}})", digest));
    }
    folder.write_log("04", log_text("rt")); // says nothing of its protocol
    expect_error(folder,
                 "sub-02_task-skin2afc_beh.json: ProtocolDigest: expected \"aa\" as in 2 runs, found \"bb\"");
    EXPECT_EQ(used_runs(read_study(folder.path(), {true, false})), "01:1 03:1 04:1 ");
    EXPECT_EQ(read_study(folder.path(), {true, false}).protocols, 1u); // the other was left out
    const Study mixed = read_study(folder.path(), {false, true});
    EXPECT_EQ(used_runs(mixed), "01:1 02:1 03:1 04:1 ");
    EXPECT_EQ(mixed.protocols, 2u);
    folder.write_sidecar("02", R"({"Protocol": "q", "ProtocolDigest": "aa"})");
    expect_error(folder, "Protocol: expected \"p\" as in 2 runs, found \"q\"");
}

TEST(StudyTest, abortedRunsDoNotChooseTheProtocol) {
    // Participant 01 tried protocol b three times, then completed a, as 02 did.
    const StudyFolder folder;
    const auto write = [&](const std::string& label, const std::string& run, const std::string& answers,
                           const std::string& digest) {
        folder.write_log(label, log_text(answers), run);
        folder.write_sidecar(label, fmt::format(R"({{"TrialsPlanned": 4, "ProtocolDigest": "{}"}})", digest),
                             run);
    };
    for (const char* run : {"_run-01", "_run-02", "_run-03"}) {
        write("01", run, "r", "bb");
    }
    write("01", "_run-04", "rrrr", "aa");
    write("02", "_run-01", "rrrr", "aa");
    const Study study = read_study(folder.path(), {true, false});
    EXPECT_EQ(used_runs(study), "01:4 02:1 ");
    EXPECT_EQ(study.bad_files.size(), 3u);
    EXPECT_EQ(read_study(folder.path(), {false, true}).protocols, 1u); // of those that count
}

TEST(StudyTest, aRunsNumberIsItsOwn) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rr"), "_run-1");
    folder.write_log("01", log_text("tt"), "_run-01");
    expect_error(folder,
                 "expected a run of its own, found run 1 in sub-01/beh/sub-01_task-skin2afc_run-01_beh.tsv "
                 "too");
    EXPECT_EQ(used_runs(read_study(folder.path(), {true, false})), "01:1 ");
}

} // namespace
