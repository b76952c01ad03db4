// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/expertise.h>

#include <map>

#include <gtest/gtest.h>

#include <stats/analysis.h>
#include <support/error.h>

#include "study_folder.h"

namespace {

/// Participants 01 to 06 with 1, 2, ... 6 errors in 10 answers.
void write_participants(const StudyFolder& folder) {
    for (int i = 1; i <= 6; ++i) {
        folder.write_log(fmt::format("{:02}", i),
                         log_text(std::string(static_cast<std::size_t>(i), 't') +
                                  std::string(static_cast<std::size_t>(10 - i), 'r')));
    }
}

TEST(ExpertiseTest, comparesErrorsWithAndWithout) {
    const StudyFolder folder;
    write_participants(folder);
    folder.write("phenotype/questionnaire.tsv",
                 "participant_id\tvision\texpertise\nsub-01\tgood\tdrawing;photography\n"
                 "sub-02\tgood\tyes\nsub-03\tgood\tGraphics\nsub-04\tgood\tnone\n"
                 "sub-05\tgood\tNo\nsub-06\tgood\t0\n");
    const auto analysis = stats::analyse_study(folder.path());
    ASSERT_EQ(analysis.expertise.size(), 1u);
    const auto& found = analysis.expertise.front();
    EXPECT_EQ(found.column, "expertise");
    EXPECT_EQ(found.with.participants, 3u);
    EXPECT_EQ(found.with.errors, 6u);
    EXPECT_EQ(found.without.errors, 15u);
    EXPECT_DOUBLE_EQ(found.with.median, 0.2);
    EXPECT_NEAR(found.rank_sum->p, 0.1, 1e-15); // complete separation: 2 of the 20 splits
    EXPECT_NEAR(found.welch->df, 4, 1e-9);
    EXPECT_EQ(expertise_sentence(found),
              "\"expertise\": 3 participants with it made 2.0 errors in 10.0 answers each, 3 without it 5.0 "
              "errors in "
              "10.0 answers each; no significant difference (rank-sum p = 0.100).");
}

TEST(ExpertiseTest, oneParticipantIsNotPlural) {
    const stats::GroupErrors none{}, one{1, 2, 10, 0.2}, two{2, 2, 20, 0.1};
    EXPECT_EQ(stats::expertise_sentence({"art", "participants.tsv", one, none, {}, {}}),
              "\"art\": 1 participant with and 0 without; nothing to compare.");
    EXPECT_EQ(
        stats::expertise_sentence({"art", "participants.tsv", one, two, stats::RankSum{.p = 0.5}, {}}),
        "\"art\": 1 participant with it made 2.0 errors in 10.0 answers, 2 without it 1.0 errors in 10.0 "
        "answers each; no significant difference (rank-sum p = 0.500).");
}

TEST(ExpertiseTest, findsItsColumnsInEitherFile) {
    const StudyFolder folder;
    write_participants(folder);
    folder.write("participants.tsv",
                 "participant_id\tage\tart_expertise\tpart\nsub-01\t30\tyes\tyes\nsub-02\t31\tno\tno\n"
                 "sub-09\t31\tno\tno\n");
    folder.write("phenotype/b.tsv",
                 "participant_id\tsmart\tComputer Graphics\r\nsub-01\tx\tn/a\r\nsub-02\tx\tno\r\n");
    folder.write("phenotype/b.json", "{}");
    const auto questions = stats::read_expertise(folder.path());
    ASSERT_EQ(questions.size(), 2u); // "part" and "smart" are no art
    EXPECT_EQ(questions[0].column, "art_expertise");
    EXPECT_EQ(questions[0].file, "participants.tsv");
    EXPECT_EQ(questions[1].column, "Computer Graphics");
    EXPECT_EQ(questions[1].by_participant.size(), 1u); // n/a is no answer
    // Who has no log counts nothing; a group of none leaves nothing to compare.
    const auto compared = stats::analyse_study(folder.path()).expertise;
    EXPECT_EQ(compared[0].without.participants, 1u);
    EXPECT_FALSE(compared[1].rank_sum);
    EXPECT_NE(expertise_sentence(compared[1]).find("nothing to compare"), std::string::npos);
}

TEST(ExpertiseTest, denialsAreNoExpertise) {
    const StudyFolder folder;
    write_participants(folder);
    folder.write("participants.tsv",
                 "participant_id\texpertise\nsub-01\t n\nsub-02\tno \nsub-03\tNone of it\n"
                 "sub-04\tno, not really\nsub-05\tnotation\nsub-06\t y \n");
    const auto questions = stats::read_expertise(folder.path());
    ASSERT_EQ(questions.size(), 1u);
    const std::map<std::string, bool> expected{{"01", false}, {"02", false}, {"03", false},
                                               {"04", false}, {"05", true},  {"06", true}};
    EXPECT_EQ(questions[0].by_participant, expected);
}

TEST(ExpertiseTest, aParticipantHasOneRow) {
    const StudyFolder folder;
    write_participants(folder);
    folder.write("participants.tsv", "participant_id\texpertise\nsub-01\tyes\nsub-02\tno\nsub-01\tno\n");
    EXPECT_NE(message_of<support::InputError>([&] {
                  stats::read_expertise(folder.path());
              }).find("participants.tsv:4: expected a participant_id of its own, found sub-01 again"),
              std::string::npos);
}

TEST(ExpertiseTest, aStudyWithoutQuestionsHasNone) {
    const StudyFolder folder;
    write_participants(folder);
    EXPECT_TRUE(stats::read_expertise(folder.path()).empty());
    folder.write("participants.tsv", "participant_id\nsub-01\n");
    EXPECT_TRUE(stats::read_expertise(folder.path()).empty());
}

TEST(ExpertiseTest, badTablesNameFileAndLine) {
    const StudyFolder folder;
    write_participants(folder);
    folder.write("participants.tsv", "participant_id\texpertise\nsub-01\tyes\nsub-02\n");
    const std::string message = message_of<support::InputError>([&] { stats::analyse_study(folder.path()); });
    EXPECT_NE(message.find("participants.tsv:3: expected 2 fields separated by tabs, found 1"),
              std::string::npos)
        << message;
    folder.write("participants.tsv", "name,expertise\n");
    EXPECT_NE(message_of<support::InputError>([&] {
                  stats::analyse_study(folder.path());
              }).find("participants.tsv:1: expected \"participant_id\""),
              std::string::npos);
    const auto lenient = stats::analyse_study(folder.path(), {}, {true, false});
    EXPECT_EQ(lenient.study.bad_files.size(), 1u);
}

} // namespace
