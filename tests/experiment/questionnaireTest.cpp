// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <deque>

#include <gtest/gtest.h>

#include <support/error.h>

#include "fixture.h"
#include "log/phenotype.h"
#include "questionnaire.h"
#include "simulated_stage.h"

namespace {

using namespace experiment;

const std::vector<study::Question> questions{
    {.id = "age", .text = "How old?", .kind = study::QuestionKind::integer, .least = 18, .most = 120},
    {.id = "sex",
     .text = "Sex?",
     .kind = study::QuestionKind::choice,
     .choices = {"F", "M"},
     .values = {"f", "m"}},
    {.id = "art",
     .text = "Which?",
     .kind = study::QuestionKind::multiple,
     .choices = {"A", "B", "C"},
     .values = {"a", "b", "c"},
     .optional = true},
    {.id = "remark", .text = "More?", .kind = study::QuestionKind::text, .optional = true}};

/// A stage whose participant gives answers that were written down before.
class ScriptedStage : public SimulatedStage {
public:
    explicit ScriptedStage(std::deque<FormAnswer> script)
        : SimulatedStage(Observer("null", study::read_protocol(SKIN2AFC_PROTOCOLS "/jimenez2009.toml")), 1),
          script_(std::move(script)) {}
    FormAnswer ask(const Form& form) override {
        asked.push_back(form);
        FormAnswer answer = script_.front();
        script_.pop_front();
        return answer;
    }
    std::vector<Form> asked;

private:
    std::deque<FormAnswer> script_;
};

FormAnswer text(const std::string& typed) { return {.text = typed}; }
FormAnswer places(std::vector<std::size_t> chosen) { return {.chosen = std::move(chosen)}; }

TEST(QuestionnaireTest, asksOneByOneAndGoesBackToAnswersGiven) {
    study::SessionSettings session;
    session.questions = questions;
    session.texts.question = "Question {trial} of {trials}";
    FormAnswer back = places({1});
    back.back = true;
    ScriptedStage stage({text("30"), back, text("31"), places({0}), places({0, 2}), text(" a\tb ")});
    EXPECT_EQ(ask_questions(session, stage),
              (Answers{{"age", "31"}, {"sex", "f"}, {"art", "a;c"}, {"remark", "a b"}}));
    ASSERT_EQ(stage.asked.size(), 6U);
    EXPECT_EQ(stage.asked[0].heading, "Question 1 of 4");
    EXPECT_FALSE(stage.asked[0].can_go_back);
    EXPECT_EQ(stage.asked[2].given.text, "30");
    EXPECT_EQ(stage.asked[3].given.chosen, std::vector<std::size_t>{1});
}

TEST(QuestionnaireTest, writesAgesAbove89As89) {
    EXPECT_EQ(written(questions[0], text("88")), "88");
    EXPECT_EQ(written(questions[0], text("90")), "89");
    study::Question other = questions[0];
    other.id = "years_of_drawing";
    EXPECT_EQ(written(other, text("90")), "90");
}

TEST(QuestionnaireTest, takesOnlyAnswersThatWillDo) {
    Form form;
    form.kind = Form::Kind::integer;
    form.least = 18;
    form.most = 120;
    for (const char* typed : {"", "17", "121", "3x", "18.5", "99999999999", " "}) {
        EXPECT_FALSE(will_do(form, text(typed))) << typed;
    }
    EXPECT_TRUE(will_do(form, text("18")));
    form.optional = true;
    EXPECT_TRUE(will_do(form, text("")));
    EXPECT_FALSE(will_do(form, text("17")));
    Form choice;
    choice.kind = Form::Kind::choice;
    EXPECT_FALSE(will_do(choice, {}));
    EXPECT_TRUE(will_do(choice, places({1})));
}

TEST(QuestionnaireTest, needsNoConsentWhereTheProtocolHasNoForm) {
    study::SessionTexts texts;
    ScriptedStage stage({places({0}), places({1})});
    EXPECT_TRUE(ask_consent(texts, stage));
    EXPECT_TRUE(stage.asked.empty());
    texts.consent = "Will you?";
    EXPECT_TRUE(ask_consent(texts, stage));
    EXPECT_FALSE(ask_consent(texts, stage));
}

TEST(AnswersTest, goToTheFilesOfBidsWithTheirDescriptions) {
    const fixture::TemporaryFolder study;
    fixture::write(study / "participants.tsv", "participant_id\tgroup\nsub-09\tA\n");
    EXPECT_FALSE(has_answered(study.path(), "01"));
    save_answers(study.path(), "01", questions,
                 {{"age", "31"}, {"sex", "f"}, {"art", "a;c"}, {"remark", "n/a"}});
    EXPECT_TRUE(has_answered(study.path(), "01"));
    EXPECT_FALSE(has_answered(study.path(), "09"));
    EXPECT_EQ(fixture::read(study / "participants.tsv"),
              "participant_id\tgroup\tage\tsex\nsub-09\tA\tn/a\tn/a\nsub-01\tn/a\t31\tf\n");
    EXPECT_EQ(fixture::read(study / "phenotype/questionnaire.tsv"),
              "participant_id\tart\tremark\nsub-01\ta;c\tn/a\n");
    const auto person = nlohmann::json::parse(fixture::read(study / "participants.json"));
    EXPECT_EQ(person["sex"]["Levels"]["f"], "F");
    EXPECT_EQ(person["age"]["Units"], "year");
    const auto tool = nlohmann::json::parse(fixture::read(study / "phenotype/questionnaire.json"));
    EXPECT_EQ(tool["art"]["Levels"]["c"], "C");
    EXPECT_TRUE(tool["MeasurementToolMetadata"]["Description"].is_string());
}

} // namespace
