// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include <support/error.h>

#include "fixture.h"
#include "schedule.h"

namespace {

using experiment::make_schedule;
using experiment::Schedule;
using experiment::Trial;

study::Protocol published() { return study::read_protocol(SKIN2AFC_PROTOCOLS "/jimenez2009.toml"); }

// [Jimenez2009, Sec. 5.3 and Appendix]: 72 pairs, 3 shaders x 3 distances x 4 angles, each pair in both
// orders.
TEST(ScheduleTest, showsEachPublishedConditionOnceInEitherOrder) {
    const Schedule schedule = make_schedule(published(), 1);
    ASSERT_EQ(schedule.size(), 72U);
    std::map<std::tuple<std::string, std::string, int>, std::multiset<std::string>> first_shown;
    for (const Trial& trial : schedule) {
        EXPECT_EQ(trial.reference, "ts");
        EXPECT_EQ((std::set{trial.first, trial.second}), (std::set{trial.reference, trial.test}));
        first_shown[{trial.test, trial.distance, trial.azimuth_deg}].insert(trial.first);
    }
    ASSERT_EQ(first_shown.size(), 36U);
    for (const auto& [condition, shaders] : first_shown) {
        EXPECT_EQ(shaders, (std::multiset<std::string>{"ts", std::get<0>(condition)}));
    }
}

TEST(ScheduleTest, needsThe48PublishedPictures) {
    EXPECT_EQ(stimuli_of(make_schedule(published(), 1)).size(), 48U);
}

TEST(ScheduleTest, isTheSameForTheSameSeedAndAnotherForAnother) {
    EXPECT_EQ(make_schedule(published(), 5), make_schedule(published(), 5));
    EXPECT_NE(make_schedule(published(), 5), make_schedule(published(), 6));
}

// The order was worked out by a second program, in Python, from the C++ standard's description of seed_seq
// and mt19937_64 ([rand.util.seedseq], [rand.eng.mers]), SHA-256, and Fisher-Yates.
TEST(ScheduleTest, isTheOrderThatTheStandardsDefine) {
    const Schedule schedule = make_schedule(published(), 2009);
    const auto trial = [](const char* test, const char* distance, int azimuth_deg, bool reference_first) {
        return Trial{
            "ts", test, distance, azimuth_deg, reference_first ? "ts" : test, reference_first ? test : "ts"};
    };
    EXPECT_EQ(schedule[0], trial("ss_jittered", "far", 60, false));
    EXPECT_EQ(schedule[1], trial("ss_full", "near", 0, false));
    EXPECT_EQ(schedule[2], trial("ss_jittered", "near", 150, true));
    EXPECT_EQ(schedule[3], trial("ss_full", "near", 150, true));
    EXPECT_EQ(schedule[71], trial("ss_jittered", "far", 0, false));
    EXPECT_EQ(experiment::default_seed(published(), "01"), 4478323650024061U);
}

TEST(ScheduleTest, drawsTheOrderByLotWhereEachPairIsShownOnce) {
    study::Protocol protocol = published();
    protocol.session.both_orders = false;
    int reference_first = 0;
    constexpr int sessions = 50;
    for (int seed = 0; seed < sessions; ++seed) {
        const Schedule schedule = make_schedule(protocol, static_cast<std::uint64_t>(seed));
        ASSERT_EQ(schedule.size(), 36U);
        EXPECT_EQ(stimuli_of(schedule).size(), 48U);
        for (const Trial& trial : schedule) {
            reference_first += trial.first == trial.reference ? 1 : 0;
        }
    }
    // 1800 fair tosses: SD 21.2; five of them are passed by chance once in two million.
    EXPECT_NEAR(reference_first, 900, 106);
}

TEST(ScheduleTest, refusesAProtocolThatComparesNothing) {
    study::Protocol protocol = published();
    protocol.session.tests.clear();
    EXPECT_THROW(make_schedule(protocol, 1), support::InputError);
}

} // namespace
