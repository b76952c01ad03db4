// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "verdicts.h"

#include <gtest/gtest.h>

#include "findings.h"
#include "labels.h"
#include "outcome.h"
#include "study_folder.h"

namespace {

using stats::Analysis;

/// A participant's answers at one place: so many of n chose the reference, the orders taking turns.
std::string answers(int k, int n) {
    std::string text;
    for (int i = 0; i < n; ++i) {
        const bool reference = i < k;
        text += i % 2 == 0 ? (reference ? 'r' : 't') : (reference ? 'R' : 'T');
    }
    return text;
}

/// A study of participants with so many answers for the reference of 18.
Analysis analysis_of(const std::vector<int>& counts, const stats::Settings& settings = {}) {
    const StudyFolder folder;
    int participant = 0;
    for (const int k : counts) {
        folder.write_log(fmt::format("{:02}", ++participant), log_text(answers(k, 18)));
    }
    return stats::analyse_study(folder.path(), settings);
}

/// A study whose participants have so many answers for the reference of 20 at each place.
struct At {
    std::string distance;
    int azimuth_deg, k;
};
Analysis analysis_at(const std::vector<At>& places, int participants) {
    const StudyFolder folder;
    for (int participant = 0; participant < participants; ++participant) {
        std::string text = log_header;
        int trial = 0;
        for (const auto& [distance, azimuth_deg, k] : places) {
            // Participants differ a little, without moving their mean.
            for (const char answer : answers(k + participant % 3 - 1, 20)) {
                text += log_line(++trial, answer, "ss_full", distance, azimuth_deg);
            }
        }
        folder.write_log(fmt::format("{:02}", participant + 1), text);
    }
    return stats::analyse_study(folder.path());
}

std::string headline_of(const Analysis& analysis) { return verdicts(analysis).front().headline; }

const std::vector<int> split_opinion{17, 4, 15, 6, 18, 9, 16, 5, 14, 12};
const std::vector<int> balanced{9, 10, 8, 9, 10, 9, 8, 9, 10, 8};

TEST(VerdictsTest, disagreementIsSaidInWords) {
    // The pooled test cries wolf (p = .0001); participants as the sample find nothing (p = .168).
    const auto analysis = analysis_of(split_opinion);
    EXPECT_TRUE(any_shader_disagrees(analysis));
    const auto sentences = disagreements(analysis);
    EXPECT_TRUE(sentences.front().starts_with(
        "Pooled and participant-level tests disagree on SS Full against TS over all conditions, with 10 "
        "participants as the sample (difference: pooled p < 0.001, sign-flip p = 0.168)"))
        << sentences.front();
    EXPECT_NE(sentences.front().find("rely on the participant-level tests"), std::string::npos);
    // One distance and one azimuth have no rows of their own to disagree.
    EXPECT_NE(sentences.at(1).find("In 1 of 1 single conditions they disagree"), std::string::npos)
        << sentences.at(1);
    EXPECT_EQ(verdict_words(analysis.groups.front(), {}), "undecided");
}

TEST(VerdictsTest, disagreementOnEquivalenceIsSaidToo) {
    // Half of all answers, so pooled equivalence is certain; participants of opposite minds leave it open.
    const auto analysis = analysis_of({18, 0, 17, 1, 18, 0, 16, 2, 18, 0});
    EXPECT_TRUE(any_shader_disagrees(analysis));
    EXPECT_NE(disagreements(analysis).front().find("(equivalence: pooled p < 0.001, over participants p = "),
              std::string::npos)
        << disagreements(analysis).front();
}

TEST(VerdictsTest, agreementIsSaidToo) {
    const auto analysis = analysis_of({17, 18, 16, 17, 18, 15, 17});
    EXPECT_FALSE(any_shader_disagrees(analysis));
    EXPECT_TRUE(disagreements(analysis).front().starts_with(
        "Pooled and participant-level tests agree on every shader over all conditions"));
}

TEST(VerdictsTest, aDifferenceNamesWhoIsPreferred) {
    EXPECT_EQ(headline_of(analysis_of({17, 18, 16, 17, 18, 15, 17})),
              "SS Full differs from TS: TS is preferred.");
    EXPECT_EQ(headline_of(analysis_of({1, 0, 2, 1, 0, 3, 1})),
              "SS Full differs from TS: SS Full is preferred.");
}

TEST(VerdictsTest, aPreferenceShownInOneOrderOnlyMayBeAHabit) {
    const StudyFolder folder;
    for (int participant = 0; participant < 8; ++participant) {
        folder.write_log(fmt::format("{:02}", participant), log_text("rrrrrr"));
    }
    EXPECT_EQ(headline_of(stats::analyse_study(folder.path())),
              "SS Full differs from TS: TS is preferred - or the interval it stood in, as no participant "
              "answered a "
              "condition in both orders.");
}

TEST(VerdictsTest, theIntervalIsThatOfTheParticipants) {
    // The mean of 17, 18, 16, 17, 18, 15, 17 of 18 is 118/126; R: t.test(k/18)$conf.int is .88158 to .99144.
    const auto evidence = verdicts(analysis_of({17, 18, 16, 17, 18, 15, 17})).front().evidence;
    EXPECT_NE(evidence.find("mean of the 7 participants 93.7 % (95 % t interval 88.2 to 99.1 %)"),
              std::string::npos)
        << evidence;
    EXPECT_NE(evidence.find("(pooled): Wilson 95 % interval"), std::string::npos) << evidence;
}

TEST(VerdictsTest, aDifferenceStandsOnlyAfterHolmsCorrection) {
    // All of six participants prefer the reference: p = 2/64, which Holm's method takes by the table's three
    // rows.
    const auto analysis = analysis_at({{"far", 60, 17}, {"near", 60, 18}}, 6);
    EXPECT_EQ(analysis.groups.front().figures->participant.sign_flip.p, 2.0 / 64);
    EXPECT_EQ(analysis.groups.front().figures->participant.p_holm, 6.0 / 64);
    EXPECT_EQ(headline_of(analysis),
              "SS Full against TS is undecided: neither a difference nor equality is shown (6 participants "
              "cannot show a difference over 3 tests; it takes 7).");
    EXPECT_NE(verdicts(analysis).front().evidence.find("over the 3 rows of the shaders' table p = 0.094"),
              std::string::npos);
}

TEST(VerdictsTest, participantsOfOneMindDiffer) {
    // No spread, so neither a t-test nor a mixed model; but all sign patterns but two are less extreme: p =
    // 2/64.
    const auto analysis = analysis_of({18, 18, 18, 18, 18, 18});
    EXPECT_FALSE(analysis.groups.front().figures->participant.t_test);
    EXPECT_EQ(headline_of(analysis), "SS Full differs from TS: TS is preferred.");
    EXPECT_NE(participant_findings(analysis.rows)
                  .front()
                  .find("SS Full differs from TS in 1 of 1 condition, TS preferred"),
              std::string::npos);
    EXPECT_EQ(
        disagreements(analysis).front(),
        "Pooled and participant-level tests agree on every shader over all conditions, on difference (p "
        "uncorrected); equivalence cannot be tested for SS Full, where all participants have the same "
        "proportion.");
}

TEST(VerdictsTest, agreementIsNotSaidOfWhatCannotBeTested) {
    // Five participants of half and half: no test finds anything, and the sign-flip test never could.
    const auto analysis = analysis_of({4, 14, 9, 9, 12}, {{0.499, 0.501}, 1});
    const auto sentences = disagreements(analysis);
    EXPECT_EQ(sentences,
              std::vector<std::string>{"Whether pooled and participant-level tests agree cannot be "
                                       "told: no sign-flip test can be significant below 6 "
                                       "participants."});
    EXPECT_NE(participant_findings(analysis.rows).front().find("no single condition can be tested"),
              std::string::npos);
}

TEST(VerdictsTest, aShaderThatFewSawIsNamedAsUntested) {
    // Seven participants on one shader, of whom three saw another one, too.
    const StudyFolder folder;
    for (int participant = 1; participant <= 7; ++participant) {
        std::string text = log_text("rRrRrRrR" + std::string(participant % 2 == 0 ? "rT" : "rR"));
        if (participant <= 3) {
            text += log_line(11, 'r', "no_sss") + log_line(12, 'T', "no_sss");
        }
        folder.write_log(fmt::format("{}", participant), text);
    }
    const auto analysis = stats::analyse_study(folder.path());
    EXPECT_EQ(
        disagreements(analysis).front(),
        "Pooled and participant-level tests agree on every shader that can be tested over all conditions, "
        "on difference and on equivalence (p uncorrected); too few participants to test No SSS (3 "
        "participants).");
    const auto sentences = participant_findings(analysis.rows);
    ASSERT_EQ(sentences.size(), 2u);
    EXPECT_NE(
        sentences[0].find("No SSS against TS cannot be tested in any condition: fewer than 6 participants"),
        std::string::npos)
        << sentences[0];
    EXPECT_NE(sentences[1].find("SS Full differs from TS in 1 of 1 condition, TS preferred"),
              std::string::npos)
        << sentences[1];
}

TEST(VerdictsTest, tooFewParticipantsCannotBeTested) {
    // One who always presses the same key, two of opposite habits, five of one mind.
    for (const auto& counts : {std::vector{9}, {9, 9}, {18, 18, 18, 18, 18}}) {
        const auto analysis = analysis_of(counts);
        EXPECT_EQ(
            headline_of(analysis),
            fmt::format("SS Full against TS cannot be tested: with {} participant{}, no sign-flip test can "
                        "be significant; it takes 6.",
                        counts.size(), counts.size() == 1 ? "" : "s"));
        EXPECT_EQ(verdict_words(analysis.groups.front(), {}), "cannot be tested");
    }
}

TEST(VerdictsTest, aPAboveTheLevelIsNotShownAsTheLevel) {
    EXPECT_EQ(stats::p_phrase(0.0501), "= 0.0501");
    EXPECT_EQ(stats::p_phrase(0.05001), "just above 0.05");
    EXPECT_EQ(stats::p_phrase(0.05), "= 0.050");
    EXPECT_EQ(stats::p_phrase(0.0505), "= 0.051");
}

TEST(VerdictsTest, sixParticipantsAreTheFewest) {
    EXPECT_EQ(stats::fewest_participants(1), 6u);   // 2/2^5 = .0625, 2/2^6 = .03125
    EXPECT_EQ(stats::fewest_participants(24), 10u); // 24 * 2/2^9 = .094, 24 * 2/2^10 = .047
}

TEST(VerdictsTest, equalityNeedsASpreadToJudgeBy) {
    EXPECT_EQ(headline_of(analysis_of({9, 9, 9, 9, 9, 9, 9, 9, 9, 9})),
              "SS Full against TS is undecided: no difference is shown, and all participants have the same "
              "proportion, which leaves no spread to judge equality by.");
}

TEST(VerdictsTest, asGoodNeedsEquivalenceAndNotOnlyAbsenceOfADifference) {
    EXPECT_EQ(headline_of(analysis_of(balanced)),
              "SS Full is as good as TS within the bounds of 0.35 to 0.65.");
    // Bounds so narrow that 180 answers cannot show it.
    const auto narrow = analysis_of(balanced, {{0.499, 0.501}, 1});
    EXPECT_EQ(verdict_words(narrow.groups.front(), {0.499, 0.501}), "undecided");
}

TEST(VerdictsTest, oppositePreferencesAreNotEquality) {
    // Over all half and half, but the reference at zoom, the test at far.
    const auto analysis = analysis_at({{"far", 0, 2}, {"near", 0, 10}, {"zoom", 0, 18}}, 12);
    EXPECT_EQ(headline_of(analysis),
              "On average over conditions, SS Full is as good as TS within the bounds of "
              "0.35 to 0.65, but not at Far (SS Full preferred) and Zoom (TS preferred).");
}

TEST(VerdictsTest, preferencesThatCancelInEveryMarginAreFound) {
    // Each distance and each azimuth is half and half; the four conditions are not.
    const auto analysis = analysis_at({{"far", 0, 2}, {"far", 60, 18}, {"near", 0, 18}, {"near", 60, 2}}, 12);
    const std::string headline = headline_of(analysis);
    EXPECT_NE(headline.find("On average over conditions"), std::string::npos) << headline;
    EXPECT_NE(headline.find("but not at Far - 0\u00b0 (SS Full preferred), Far - 60\u00b0 (TS preferred)"),
              std::string::npos)
        << headline;
}

TEST(VerdictsTest, aDifferenceSaysWhereItTurnsRound) {
    const auto analysis = analysis_at({{"far", 0, 2}, {"near", 0, 18}, {"zoom", 0, 19}}, 12);
    EXPECT_NE(headline_of(analysis).find("TS is preferred, but not at Far (SS Full preferred)"),
              std::string::npos)
        << headline_of(analysis);
}

TEST(VerdictsTest, aSmallDifferenceMayLieWithinTheBounds) {
    EXPECT_EQ(headline_of(analysis_of({10, 11, 10, 10, 11, 10, 10, 11, 10, 10})),
              "SS Full differs from TS: TS is preferred, yet within the bounds of 0.35 to 0.65.");
}

TEST(VerdictsTest, publishedCountsSayWhatThePaperSays) {
    // As few participants as make the first ones choose: the pooled p of SS Full is of no difference.
    const StudyFolder folder;
    folder.write_published_logs();
    const auto analysis = stats::analyse_study(folder.path());
    for (const stats::GroupRow* group : overall(analysis.groups)) {
        const bool differs = verdict_words(*group, {}).starts_with("differs");
        EXPECT_EQ(differs, group->figures->participant.p_holm <= 0.05) << group->test;
    }
}

TEST(VerdictsTest, aDrawnPNearTheLevelDecidesNothing) {
    stats::Figures figures;
    figures.proportion = 0.6;
    figures.participant.participants = 100;
    figures.participant.p_equivalence = 0.5;
    figures.participant.sign_flip = {0.016, 0.0006, false};
    figures.participant.p_holm = 0.048; // three times as large, and so is its error of .0018
    EXPECT_EQ(stats::outcome_of(figures).kind, stats::Outcome::Kind::undecided);
    EXPECT_NE(stats::outcome_of(figures).why.find("within three standard errors of 0.05"), std::string::npos);
    EXPECT_EQ(stats::sign_flip_phrase(figures.participant.sign_flip),
              "= 0.016 (drawn at random, standard error 0.0006)");
    figures.participant.sign_flip.standard_error = 0.0001;
    EXPECT_TRUE(stats::outcome_of(figures).differs());
    figures.participant.sign_flip = {0.016, 0, true};
    EXPECT_EQ(stats::sign_flip_phrase(figures.participant.sign_flip), "= 0.016");
    EXPECT_TRUE(stats::outcome_of(figures).differs());
}

/// Participants who give the same answers, one string each.
Analysis answering(const std::vector<std::string>& participants) {
    const StudyFolder folder;
    for (std::size_t i = 0; i < participants.size(); ++i) {
        folder.write_log(fmt::format("{:02}", i + 1), log_text(participants[i]));
    }
    return stats::analyse_study(folder.path());
}

TEST(VerdictsTest, biasToAnIntervalIsToldFromAPreference) {
    // With one order only, always the reference is always the first interval: neither can be told.
    EXPECT_NE(order_sentence(answering(std::vector<std::string>(8, "rrrrrr")))
                  .find("cannot be separated from a preference"),
              std::string::npos);
    // Both orders: always the reference is a preference, always the first interval a bias.
    const std::vector<std::string> reference(8, "rRrRrR"), first(8, "rTrTrT"), second(8, "tRtRtR");
    EXPECT_NE(order_sentence(answering(reference)).find("no bias to either interval is shown"),
              std::string::npos);
    EXPECT_NE(
        order_sentence(answering(first))
            .find("the mean of 8 participants 100.0 % (sign-flip p = 0.008): a bias to the first interval"),
        std::string::npos)
        << order_sentence(answering(first));
    EXPECT_NE(order_sentence(answering(second)).find("a bias to the second interval"), std::string::npos);
    // The reference first in four of five, and always preferred: the first interval is chosen in 80 %.
    EXPECT_NE(
        order_sentence(answering(std::vector<std::string>(8, "rrrrR")))
            .find("in 32 of 40 answers (80.0 %); freed from preference, the mean of 8 participants 50.0 %"),
        std::string::npos);
}

TEST(VerdictsTest, aFewBiasedParticipantsAreNotABiasOfAll) {
    // Three always press the first key, thirteen are fair: the pooled p is below .001, p over participants is
    // 2/8.
    std::vector<std::string> participants(13, "rRtTrRtTrRtTrRtT");
    participants.insert(participants.end(), 3, "rTrTrTrTrTrTrTrT");
    const auto analysis = answering(participants);
    EXPECT_LT(analysis.groups.front().figures->p_order, 0.01);
    EXPECT_NE(order_sentence(analysis).find("(sign-flip p = 0.250): no bias"), std::string::npos)
        << order_sentence(analysis);
    EXPECT_NE(order_sentence(answering({"rTrTrT", "rTrTrT"})).find("too few to test; it takes 6"),
              std::string::npos);
}

} // namespace
