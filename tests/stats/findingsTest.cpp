// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "findings.h"

#include <gtest/gtest.h>

#include <stats/table.h>

#include "study_folder.h"

namespace {

using stats::Row;

/// Rows of one test shader at azimuths 0, 1, ...; counts of 32 that chose the reference.
std::vector<Row> rows_of(const std::vector<std::int64_t>& counts) {
    std::vector<stats::Answers> answers;
    for (const auto count : counts) {
        stats::Answers one;
        one.tally = {32, count};
        answers.push_back(one);
    }
    const auto figures = stats::figures_of(answers);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        rows.push_back({{"ts", "ss_full", "far", static_cast<double>(i)}, answers[i].tally, figures[i]});
    }
    return rows;
}

TEST(FindingsTest, sayWhatThePaperSays) {
    const StudyFolder folder;
    folder.write_published_logs();
    const auto sentences = findings(make_table(stats::read_study(folder.path())));
    ASSERT_EQ(sentences.size(), 4u);
    EXPECT_TRUE(sentences[0].starts_with("As the paper tests, No SSS differs from TS in all 12 conditions"))
        << sentences[0];
    EXPECT_TRUE(
        sentences[1].starts_with("As the paper tests, SS Jittered differs from TS in all 12 conditions"))
        << sentences[1];
    EXPECT_TRUE(sentences[2].starts_with("As the paper tests, SS Full shows no significant difference from "
                                         "TS in 11 of 12 conditions (pooled p > "
                                         "0.05); it differs in Zoom - 110\u00b0 (p = 0.034)."))
        << sentences[2];
    EXPECT_NE(sentences[3].find("25 uncorrected, 24 after Holm's correction, 25 after"), std::string::npos)
        << sentences[3];
    EXPECT_NE(sentences[3].find("Not significant after Holm's: SS Full against TS at Zoom - 110\u00b0"),
              std::string::npos)
        << sentences[3];
}

TEST(FindingsTest, sayWhichShaderWasPreferred) {
    // Both conditions differ, in opposite directions: 32 of 32 and 2 of 32.
    const auto text = findings(rows_of({32, 2})).front();
    EXPECT_NE(text.find("in 1 of the conditions that differ, SS Full was the one preferred"),
              std::string::npos)
        << text;
    const auto both = findings(rows_of({0, 2})).front();
    EXPECT_NE(both.find("; SS Full was the one preferred there"), std::string::npos) << both;
    EXPECT_EQ(findings(rows_of({32, 30})).front().find("preferred"), std::string::npos);
}

TEST(FindingsTest, nameTheSmallerPart) {
    const auto mostly = findings(rows_of({32, 32, 16})).front();
    EXPECT_NE(
        mostly.find("in 2 of 3 conditions (pooled p \u2264 0.05), but not in Far - 2\u00b0 (p = 1.000)"),
        std::string::npos)
        << mostly;
    const auto none = findings(rows_of({16, 17}));
    EXPECT_NE(none.front().find("no significant difference from TS in any of the 2 conditions"),
              std::string::npos);
    EXPECT_NE(none.back().find("None is significant"), std::string::npos) << none.back();
    EXPECT_EQ(findings(rows_of({16})).size(), 1u);
}

TEST(FindingsTest, participantsAreTheSampleByHolm) {
    // Each of 16 participants: always the reference at far, 9 of 16 participants at near.
    const StudyFolder folder;
    for (int participant = 0; participant < 16; ++participant) {
        folder.write_log(fmt::format("{:02}", participant),
                         log_header + log_line(1, 'r') +
                             log_line(2, participant < 9 ? 'r' : 't', "ss_full", "near"));
    }
    EXPECT_EQ(
        participant_findings(make_table(stats::read_study(folder.path()))),
        std::vector<std::string>{"With participants as the sample (sign-flip test, Holm's method over 2 "
                                 "conditions), SS Full differs from TS in 1 of 2 conditions: Far - 60\u00b0 "
                                 "(TS preferred, p < 0.001)."}); // 2 * 2/2^16
}

TEST(FindingsTest, thePapersSingleDifferenceDoesNotStandOverParticipants) {
    const StudyFolder folder;
    folder.write_published_logs();
    const auto rows = make_table(stats::read_study(folder.path()));
    const auto sentences = participant_findings(rows);
    ASSERT_EQ(sentences.size(), 3u);
    EXPECT_TRUE(sentences[2].ends_with("SS Full differs from TS in 0 of 12 conditions.")) << sentences[2];
}

TEST(FindingsTest, tooFewParticipantsAreSaid) {
    const StudyFolder folder;
    for (const char* label : {"01", "02", "03", "04"}) {
        folder.write_log(label, log_text("rrrrrr"));
    }
    EXPECT_EQ(
        participant_findings(make_table(stats::read_study(folder.path()))).front(),
        "With participants as the sample, no single condition can be tested: over 1 test, 4 participants "
        "cannot reach significance by Holm's method; it takes 6.");
}

TEST(FindingsTest, simulatedNoticeCountsTheRuns) {
    stats::Study study;
    study.runs.resize(3);
    study.runs[0].used = study.runs[1].used = true;
    EXPECT_EQ(stats::simulated_notice(study), "");
    study.runs[2].sidecar.simulated = true; // does not count
    EXPECT_EQ(stats::simulated_notice(study), "");
    study.runs[0].sidecar.simulated = true;
    EXPECT_EQ(stats::simulated_notice(study), "SIMULATED DATA: 1 of the 2 runs is simulated.");
    study.simulated = true;
    EXPECT_EQ(stats::simulated_notice(study), "SIMULATED DATA: no person gave these answers.");
}

} // namespace
