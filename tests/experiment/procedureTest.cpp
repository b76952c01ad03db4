// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <gtest/gtest.h>

#include "fixture.h"
#include "procedure.h"
#include "simulated_stage.h"

namespace {

using namespace experiment;

/// A stage that writes down what happens on it; its clock advances by a second with each picture and each
/// key.
class WitnessStage : public Stage {
public:
    explicit WitnessStage(const SessionLog& log) : log_(log) {}

    double show_after(double duration_s, const Picture& picture) override {
        if (const auto* page = std::get_if<Page>(&picture)) {
            events.push_back("page " + page->text.substr(0, 7));
        } else if (const auto* stimulus = std::get_if<Stimulus>(&picture)) {
            events.push_back(fmt::format("{} after {} s", stimulus->shader, duration_s));
        } else {
            events.push_back(fmt::format("grey {}", std::get<Grey>(picture).level));
        }
        saved_when_shown.push_back(fixture::read_log(log_.path()).size());
        return ++now_s_;
    }
    Press wait_for(std::initializer_list<Key> keys) override {
        events.push_back(keys.size() == 1 ? "space?" : "1 or 2?");
        return {keys.size() == 1 ? Key::space : Key::two, ++now_s_};
    }
    FormAnswer ask(const Form& form) override {
        events.push_back("form " + form.id);
        return {};
    }
    bool tell_trouble(const std::string& message) override {
        events.push_back("trouble " + message);
        return false;
    }
    StageFacts facts() const override { return {}; }
    double now_s() const override { return now_s_; }

    std::vector<std::string> events;
    std::vector<std::size_t> saved_when_shown;

private:
    const SessionLog& log_;
    double now_s_ = 100;
};

void run(const study::Protocol& protocol, const Schedule& schedule, Stage& stage, SessionLog& log) {
    run_trials({.session = protocol.session, .schedule = schedule}, stage, log);
}

TEST(ProcedureTest, fillsInTheTrialNumbers) {
    EXPECT_EQ(fill_in("{trial}/{trials} {trial}{", 3, 72), "3/72 3{");
}

// [Jimenez2009, Sec. 5.3]: a trial number, the images one after the other, two seconds of 50 % grey between.
TEST(ProcedureTest, runsEachTrialAsPublished) {
    const fixture::TemporaryFolder folder;
    const auto protocol = fixture::small_protocol(folder.path(), "[0]", 2);
    const Schedule schedule{{"ts", "no_sss", "near", 0, "no_sss", "ts"}};
    SessionLog log = SessionLog::create(folder / "study", "01");
    WitnessStage stage(log);
    run(protocol, schedule, stage, log);
    run_end_page(protocol.session, schedule, stage);
    EXPECT_EQ(stage.events, (std::vector<std::string>{"page You wil", "space?", "page Trial 1", "space?",
                                                      "no_sss after 0 s", "space?", "grey 0.5",
                                                      "ts after 2 s", "1 or 2?", "page That wa", "space?"}));
}

TEST(ProcedureTest, savesEachAnswerBeforeAnythingElseIsShown) {
    const fixture::TemporaryFolder folder;
    const auto protocol = fixture::small_protocol(folder.path(), "[0, 60]");
    SessionLog log = SessionLog::create(folder / "study", "01");
    WitnessStage stage(log);
    run(protocol, make_schedule(protocol, 1), stage, log);
    // Instructions, then four pictures a trial: all show what the trials before have left.
    EXPECT_EQ(stage.saved_when_shown,
              (std::vector<std::size_t>{0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3}));
}

TEST(ProcedureTest, logsTimesFromTheInstructionsAndTheSecondPicture) {
    const fixture::TemporaryFolder folder;
    const auto protocol = fixture::small_protocol(folder.path());
    SessionLog log = SessionLog::create(folder / "study", "01");
    WitnessStage stage(log);
    run(protocol, make_schedule(protocol, 1), stage, log);
    const auto row = fixture::read_log(log.path()).front();
    // By the stage's clock: instructions at 101, number at 103, first at 105, grey at 107, second at 108, key
    // at 109.
    EXPECT_EQ(row.at("onset_first"), "4.000000");
    EXPECT_EQ(row.at("onset_grey"), "6.000000");
    EXPECT_EQ(row.at("onset_second"), "7.000000");
    EXPECT_EQ(row.at("response_time"), "1.000000");
    EXPECT_EQ(row.at("response"), "2");
    EXPECT_EQ(row.at("chosen"), row.at("second"));
}

TEST(ProcedureTest, keepsTheGreyOfASimulatedSessionExact) {
    const fixture::TemporaryFolder folder;
    const auto protocol = study::read_protocol(SKIN2AFC_PROTOCOLS "/jimenez2009.toml");
    SessionLog log = SessionLog::create(folder / "study", "01");
    SimulatedStage stage(Observer("null", protocol), 1);
    run(protocol, make_schedule(protocol, 1), stage, log);
    const auto rows = fixture::read_log(log.path());
    ASSERT_EQ(rows.size(), 72U);
    double last_s = 0;
    for (const auto& row : rows) {
        // Microseconds are what the log keeps.
        EXPECT_NEAR(std::stod(row.at("onset_second")) - std::stod(row.at("onset_grey")), 2, 1.1e-6);
        EXPECT_GT(std::stod(row.at("onset_first")), last_s);
        EXPECT_GT(std::stod(row.at("response_time")), 0);
        last_s = std::stod(row.at("onset_second")) + std::stod(row.at("response_time"));
    }
}

} // namespace
