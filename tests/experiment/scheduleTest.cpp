// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cstdlib>
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

TEST(ScheduleTest, letsNoConditionFollowItselfWhereAsked) {
    study::Protocol protocol = published();
    protocol.session.immediate_repeats = false;
    int repeats_allowed = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Schedule schedule = make_schedule(protocol, seed);
        for (std::size_t i = 1; i < schedule.size(); ++i) {
            EXPECT_FALSE(schedule[i].same_condition(schedule[i - 1])) << seed << " " << i;
        }
        Schedule free = make_schedule(published(), seed);
        for (std::size_t i = 1; i < free.size(); ++i) {
            repeats_allowed += free[i].same_condition(free[i - 1]) ? 1 : 0;
        }
        // It is still every trial once.
        const auto by_words = [](const Trial& a, const Trial& b) { return text_of(a) < text_of(b); };
        std::sort(schedule.begin(), schedule.end(), by_words);
        std::sort(free.begin(), free.end(), by_words);
        EXPECT_EQ(schedule, free);
    }
    EXPECT_GT(repeats_allowed, 0); // or the test has shown nothing: one a shuffle is expected
    protocol.session.tests = {"no_sss"};
    protocol.camera.distances.resize(1);
    protocol.light.azimuths_deg.resize(1);
    EXPECT_THROW(make_schedule(protocol, 1), support::InputError);
}

TEST(ScheduleTest, balancesWhichOrderComesFirstOverParticipants) {
    std::vector<Schedule> finished;
    for (std::uint64_t participant = 0; participant < 16; ++participant) {
        const Schedule shuffled = make_schedule(published(), participant);
        const Schedule schedule = balanced(shuffled, finished);
        ASSERT_EQ(schedule.size(), shuffled.size());
        for (std::size_t i = 0; i < schedule.size(); ++i) {
            EXPECT_TRUE(schedule[i].same_condition(shuffled[i])); // the places stay
        }
        if (finished.empty()) {
            EXPECT_EQ(schedule, shuffled); // nothing to balance
        }
        finished.push_back(schedule);

        // How many saw the reference first, by condition, at its first showing.
        std::map<std::string, int> reference_first, seen;
        for (const Schedule& other : finished) {
            std::set<std::string> conditions;
            std::set<std::string> trials;
            for (const Trial& trial : other) {
                const std::string condition = trial.test + trial.distance + std::to_string(trial.azimuth_deg);
                EXPECT_TRUE(trials.insert(text_of(trial)).second);
                if (conditions.insert(condition).second) {
                    ++seen[condition];
                    reference_first[condition] += trial.first == trial.reference ? 1 : 0;
                }
            }
        }
        for (const auto& [condition, count] : seen) {
            // As even as a whole number of participants can be.
            EXPECT_LE(std::abs(2 * reference_first[condition] - count), 1) << condition;
        }
    }
}

TEST(ScheduleTest, drawsPracticeFromItsOwnTrials) {
    const Schedule schedule = make_schedule(published(), 1);
    const Schedule practice = practice_trials(schedule, 100, 1);
    ASSERT_EQ(practice.size(), 100U);
    for (const Trial& trial : practice) {
        EXPECT_NE(std::find(schedule.begin(), schedule.end(), trial), schedule.end());
    }
    EXPECT_EQ(practice, practice_trials(schedule, 100, 1));
    EXPECT_NE(practice, practice_trials(schedule, 100, 2));
}

TEST(ScheduleTest, refusesAProtocolThatComparesNothing) {
    study::Protocol protocol = published();
    protocol.session.tests.clear();
    EXPECT_THROW(make_schedule(protocol, 1), support::InputError);
}

} // namespace
