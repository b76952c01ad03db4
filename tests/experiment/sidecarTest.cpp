// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "fixture.h"
#include "log/frame_table.h"
#include "log/sidecar.h"
#include "questionnaire.h"

namespace {

using namespace experiment;

/// A stage that knows of a screen and shows nothing.
class FactsStage : public Stage {
public:
    double show_after(double, const Picture&) override { return 0; }
    Press wait_for(std::initializer_list<Key>) override { return {}; }
    FormAnswer ask(const Form&) override { return {}; }
    bool tell_trouble(const std::string&) override { return false; }
    StageFacts facts() const override { return known; }
    double now_s() const override { return 0; }
    std::vector<Flip> flips() const override { return shown; }

    StageFacts known;
    std::vector<Flip> shown;
};

class SidecarTest : public testing::Test {
protected:
    SidecarTest() {
        stage_.known.pacing = "vsync";
        stage_.known.monitor = "1: A";
        stage_.known.refresh_hz = 60;
        stage_.known.dropped_frames = 2;
        stage_.known.worst_key_delay_s = 0.004;
        stage_.shown = {{.trial = 1, .picture = "page", .missed_frames = 2},
                        {.trial = 1, .picture = "grey"},
                        {.trial = 1, .picture = "grey", .frame = 2}};
        plan_.schedule = make_schedule(protocol_, 1);
    }
    Sidecar begin() const { return {folder_ / "x.json", protocol_, plan_, "digest", stage_.facts()}; }

    fixture::TemporaryFolder folder_;
    study::Protocol protocol_ = fixture::small_protocol(folder_.path());
    SessionPlan plan_;
    FactsStage stage_;
};

TEST_F(SidecarTest, addsUpThePartsAndKeepsEachPartsScreen) {
    Sidecar first = begin();
    first.finish(1, "interrupted", stage_, {{0.001}, {0.002}});
    EXPECT_EQ(first.content()["Parts"][0]["Trials"][0].dump(),
              R"({"Trial":1,"GreyError":0.001,"SaveTime":0.002,"Pictures":2,"Frames":3,"DroppedFrames":2})");

    plan_.sidecar = first.content();
    plan_.log.emplace();
    plan_.log->trials = {plan_.schedule[0]};
    stage_.known.monitor = "2: B";
    stage_.known.dropped_frames = 3;
    stage_.known.worst_key_delay_s = 0.001;
    Sidecar second = begin();
    second.finish(2, "all trials answered", stage_, {});
    const auto& content = second.content();
    EXPECT_EQ(content["DroppedFrames"], 5);
    EXPECT_EQ(content["WorstKeyDelay"], 0.004);
    EXPECT_EQ(content["Monitor"], "1: A"); // that the run began with
    EXPECT_EQ(content["Parts"][0]["Monitor"], "1: A");
    EXPECT_EQ(content["Parts"][1]["Monitor"], "2: B");
    EXPECT_EQ(content["Parts"][1]["DroppedFrames"], 3);
}

TEST_F(SidecarTest, tellsOneScreenFromAnother) {
    const auto content = begin().content();
    EXPECT_TRUE(screen_changes({}, stage_.facts()).empty());
    stage_.known.refresh_hz = 60.01; // the same, measured anew
    EXPECT_TRUE(screen_changes(content, stage_.facts()).empty());
    stage_.known.refresh_hz = 75;
    stage_.known.monitor = "2: B";
    ASSERT_EQ(screen_changes(content, stage_.facts()).size(), 2U);
    EXPECT_EQ(screen_changes(content, stage_.facts())[0],
              "Monitor is \"2: B\", and was \"1: A\" when the run was broken off");
}

// What a kill leaves is what was written before it.
TEST_F(SidecarTest, hasFramesOnFileBeforeTheSessionEnds) {
    FrameTable frames(folder_ / "frames.tsv", stage_, "sub-01_run-01", 2);
    frames.write();
    ASSERT_EQ(fixture::read_log(folder_ / "frames.tsv").size(), 3U);
    stage_.shown.push_back({.trial = 2, .picture = "grey"});
    frames.write();
    const auto rows = fixture::read_log(folder_ / "frames.tsv");
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[2].at("frame"), "2");
    EXPECT_EQ(rows[3].at("trial"), "2");
    EXPECT_EQ(rows[3].at("part"), "2");
    EXPECT_EQ(rows[3].at("run"), "sub-01_run-01");
}

TEST(NoneTest, excludesTheOtherChoicesAndIsNoMissingAnswer) {
    const auto protocol = study::read_protocol(SKIN2AFC_PROTOCOLS "/jimenez2009.toml");
    const study::Question& art = protocol.session.questions.back();
    ASSERT_EQ(art.none_place(), 5U);
    EXPECT_FALSE(art.optional);
    Form form;
    form.kind = Form::Kind::multiple;
    form.choices = art.choices;
    form.alone = art.none_place();
    FormAnswer answer;
    choose(form, 0, answer);
    choose(form, 2, answer);
    choose(form, 5, answer);
    EXPECT_EQ(written(art, answer), "none");
    choose(form, 1, answer);
    EXPECT_EQ(written(art, answer), "photography");
}

} // namespace
