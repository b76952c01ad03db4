// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/quality.h>

#include <gtest/gtest.h>

#include "study_folder.h"

namespace {

/// A log's line with another response time.
std::string timed(int trial, char answer, const std::string& time) {
    std::string line = log_line(trial, answer);
    return line.replace(line.find("\t1.5\t"), 5, "\t" + time + "\t");
}

bool any(const std::vector<std::string>& notes, const std::string& part) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(QualityTest, countsWhatIsMissingFastAndWrong) {
    const StudyFolder folder;
    folder.write_log("01", log_header + timed(1, 'r', "0.299") + timed(2, 't', "0.3") + timed(3, 'n', "n/a") +
                               timed(4, 't', "2"));
    const auto study = stats::read_study(folder.path());
    const auto found = participant_quality(study);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].trials, 4u);
    EXPECT_EQ(found[0].missing, 1u);
    EXPECT_EQ(found[0].fast, 1u);
    EXPECT_EQ(found[0].errors, 2u);
    EXPECT_EQ(found[0].median_response_time_s, 0.3);
    const auto notes = quality_notes(study, found);
    EXPECT_TRUE(any(notes, "Trials without an answer, left out: sub-01 (1 of 4)."));
    EXPECT_TRUE(any(notes, "Answers within 300 ms of the second picture, kept: sub-01 (1 of 4)."));
}

TEST(QualityTest, namesWhoAlwaysChoosesTheSameInterval) {
    // A capital: the reference was shown second, so that choosing it is choosing the second interval.
    const StudyFolder folder;
    folder.write_log("first", log_text("rTrTrTrTrTrT"));
    folder.write_log("second", log_text("tRtRtRtRtRtR"));
    folder.write_log("few", log_text("rTr"));
    folder.write_log("mixed", log_text("rRtTrRtTrRtT"));
    folder.write_log("mostly", log_text("rTrTrTrTrTrTrTrTrTtT"));
    const auto study = stats::read_study(folder.path());
    const auto found = participant_quality(study);
    ASSERT_EQ(found.size(), 5u); // few, first, mixed, mostly, second
    EXPECT_FALSE(found[0].always_same_interval());
    EXPECT_TRUE(found[1].always_same_interval());
    EXPECT_FALSE(found[2].always_same_interval() || found[2].favours_interval());
    EXPECT_TRUE(found[3].favours_interval());
    EXPECT_TRUE(found[4].always_same_interval());
    const auto notes = quality_notes(study, found);
    EXPECT_TRUE(any(
        notes, "Always chose the same interval, kept: sub-first (first in 12 of 12) and sub-second (first "
               "in 0 of 12)."));
    EXPECT_TRUE(any(
        notes, "Favour one interval, whatever it showed (p < 0.001), kept: sub-mostly (first in 19 of 20)."));
}

TEST(QualityTest, aPreferenceIsNoHabit) {
    // Always the reference: with it always first, or mostly first, that is a preference as well as a habit.
    const StudyFolder folder;
    folder.write_log("mostly", log_text("rrrrrrrrrrrrrrrrrrrrR"));
    folder.write_log("one", log_text("rrrrrrrrrrrrrrrrrrrr"));
    const auto found = participant_quality(stats::read_study(folder.path()));
    EXPECT_LT(found[0].p_first, 0.001);
    for (const auto& one : found) {
        EXPECT_EQ(one.p_order, 1);
        EXPECT_FALSE(one.always_same_interval() || one.favours_interval()) << one.participant;
    }
}

TEST(QualityTest, addsUpDroppedFrames) {
    const StudyFolder folder;
    for (const auto& [label, frames] : {std::pair("01", "3"), {"02", "0"}, {"03", "\"n/a\""}, {"04", "4"}}) {
        folder.write_log(label, log_text("rt"));
        folder.write_sidecar(label, fmt::format(R"({{"DroppedFrames": {}}})", frames));
    }
    const auto study = stats::read_study(folder.path());
    const auto found = participant_quality(study);
    EXPECT_EQ(found[0].dropped_frames, 3);
    EXPECT_FALSE(found[2].dropped_frames);
    EXPECT_TRUE(any(quality_notes(study, found), "Dropped frames: 7 in 2 runs."));
    const std::string text = to_tsv(found, false);
    EXPECT_NE(text.find("\tn/a\tfalse\tn/a\n"), std::string::npos);
    EXPECT_NE(text.find("sub-04\tsub-04/beh/sub-04_task-skin2afc_beh.tsv\ttrue\t2\t0\t0\t1\t1\t1\tn/"
                        "a\t1.5\t4\tfalse\tn/a\n"),
              std::string::npos)
        << text;
}

TEST(QualityTest, incompleteRunsThatCountAreNamed) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtrt"));
    folder.write_log("02", log_text("r"));
    const auto study = stats::read_study(folder.path());
    EXPECT_TRUE(any(quality_notes(study, participant_quality(study)),
                    "Incomplete runs: sub-02 counts with 1 of 4 trials."));
}

TEST(QualityTest, differentSetsOfStimuliAreTold) {
    const StudyFolder folder;
    for (const char digit : {'a', 'b'}) {
        folder.write_log(std::string(1, digit), log_text("rt"));
        folder.write_sidecar(std::string(1, digit),
                             fmt::format(R"({{"StimuliManifestDigest": "{}"}})", std::string(64, digit)));
    }
    const auto study = stats::read_study(folder.path());
    EXPECT_TRUE(any(quality_notes(study, participant_quality(study)),
                    "Runs with 2 different sets of stimuli are taken together"));
    // A run that names none is no other set.
    folder.write_sidecar("b", "{}");
    const auto one = stats::read_study(folder.path());
    EXPECT_FALSE(any(quality_notes(one, participant_quality(one)), "sets of stimuli"));
}

TEST(QualityTest, irregularRunsAreNamed) {
    const StudyFolder folder;
    folder.write_log("01", log_text("rtrt"));
    folder.write_sidecar("01", R"({"TrialsPlanned": 2})");
    folder.write_log("02", log_header + log_line(1, 'r') + log_line(7, 't'));
    folder.write_sidecar("02", R"({"TrialsPlanned": 2})");
    folder.write_log("03", log_header + timed(1, 'r', "1e9") + timed(2, 'r', "3600"));
    folder.write_sidecar("03", R"({"TrialsPlanned": 2})");
    const auto study = stats::read_study(folder.path());
    const auto notes = quality_notes(study, participant_quality(study));
    EXPECT_TRUE(any(notes, "More trials than planned, kept: sub-01 (4, not 2)."));
    EXPECT_TRUE(any(notes, "Numbers of trials are missing: sub-02 (2 trials, the last number 7)."));
    EXPECT_TRUE(any(notes, "Answers after more than an hour, kept: sub-03 (1 of 2)."));
    EXPECT_FALSE(any(notes, "not recorded"));
}

TEST(QualityTest, timesThatAreNotRecordedAreNotFast) {
    const StudyFolder folder;
    folder.write_log("01", log_header + timed(1, 'r', "n/a") + timed(2, 't', "n/a"));
    const auto study = stats::read_study(folder.path());
    EXPECT_TRUE(any(quality_notes(study, participant_quality(study)), "Response times are not recorded"));
}

} // namespace
