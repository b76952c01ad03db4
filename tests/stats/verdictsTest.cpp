// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "verdicts.h"

#include <gtest/gtest.h>

#include "study_folder.h"

namespace {

/// A study of participants with so many answers for the reference of 18.
stats::Analysis analysis_of(const std::vector<int>& counts, const stats::Settings& settings = {}) {
    const StudyFolder folder;
    int participant = 0;
    for (const int k : counts) {
        folder.write_log(fmt::format("{:02}", ++participant),
                         log_text(std::string(static_cast<std::size_t>(k), 'r') +
                                  std::string(static_cast<std::size_t>(18 - k), 't')));
    }
    return stats::analyse_study(folder.path(), settings);
}

const std::vector<int> split_opinion{17, 4, 15, 6, 18, 9, 16, 5, 14, 12};

TEST(VerdictsTest, disagreementIsSaidInWords) {
    // The pooled test cries wolf (p = .0001); participants as the sample find nothing (p = .168).
    const auto analysis = analysis_of(split_opinion);
    EXPECT_TRUE(any_shader_disagrees(analysis));
    const auto sentences = disagreements(analysis);
    EXPECT_TRUE(sentences.front().starts_with(
        "Pooled and participant-level tests disagree on SS Full against TS over "
        "all conditions: with all answers as if independent p < 0.001, with the "
        "10 participants as the sample p = 0.168"))
        << sentences.front();
    EXPECT_NE(sentences.front().find("rely on the participant-level test"), std::string::npos);
    EXPECT_EQ(verdict_words(*analysis.groups.front().figures, {}), "undecided");
}

TEST(VerdictsTest, agreementIsSaidToo) {
    const auto analysis = analysis_of({17, 18, 16, 17, 18, 15, 17});
    EXPECT_FALSE(any_shader_disagrees(analysis));
    EXPECT_EQ(disagreements(analysis).front(),
              "Pooled and participant-level tests agree on every shader over all conditions.");
    const auto found = verdicts(analysis);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().headline, "SS Full differs from TS.");
    EXPECT_NE(found.front().evidence.find("TS was chosen in 93.7 % of answers"),
              std::string::npos) // 118 of 126
        << found.front().evidence;
}

TEST(VerdictsTest, asGoodNeedsEquivalenceAndNotOnlyAbsenceOfADifference) {
    const auto few = analysis_of({9, 10});
    EXPECT_EQ(verdicts(few).front().headline,
              "SS Full against TS is undecided: neither a difference nor equality is shown.");
    const std::vector<int> balanced{9, 10, 8, 9, 10, 9, 8, 9, 10, 8};
    EXPECT_EQ(verdicts(analysis_of(balanced)).front().headline,
              "SS Full is as good as TS within the bounds of 0.35 to 0.65.");
    // Bounds so narrow that 180 answers cannot show it; 90 of 180 in spread 0.05.
    EXPECT_EQ(
        verdict_words(*analysis_of(balanced, {{0.499, 0.501}, 1}).groups.front().figures, {0.499, 0.501}),
        "undecided");
}

TEST(VerdictsTest, aSmallDifferenceMayLieWithinTheBounds) {
    const auto analysis = analysis_of({10, 11, 10, 10, 11, 10, 10, 11, 10, 10});
    EXPECT_EQ(verdicts(analysis).front().headline,
              "SS Full differs from TS, yet within the bounds of 0.35 to 0.65.");
}

TEST(VerdictsTest, biasToAnIntervalIsNamed) {
    // The reference always came first here: choosing it is choosing the first interval.
    EXPECT_NE(order_sentence(analysis_of({18, 18}))
                  .find("36 of 36 answers (100.0 %; exact p < 0.001): a bias to the "
                        "first interval"),
              std::string::npos);
    EXPECT_NE(order_sentence(analysis_of({0, 0})).find("a bias to the second interval"), std::string::npos);
    EXPECT_NE(order_sentence(analysis_of({9, 9})).find("no bias to either interval is shown"),
              std::string::npos);
}

} // namespace
