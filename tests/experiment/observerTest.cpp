// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include <support/error.h>

#include "fixture.h"
#include "observer.h"
#include "simulated_stage.h"

namespace {

using experiment::Observer;

study::Protocol published() { return study::read_protocol(SKIN2AFC_PROTOCOLS "/jimenez2009.toml"); }

std::string message_of(const std::string& toml) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "o.toml", toml);
    try {
        const Observer observer((folder / "o.toml").string(), published());
    } catch (const support::InputError& error) {
        return error.what();
    }
    return "no error";
}

// The chi-square values as printed in [Jimenez2009, Table II]: columns No SSS, SS Jittered, SS Full.
constexpr const char* table_ii = R"(
far 0 21.125 21.125 3.125
far 60 28.125 18 3.125
far 110 24.5 15.125 0.125
far 150 32 15.125 0
near 0 32 28.125 0
near 60 32 28.125 0.125
near 110 24.5 28.125 1.125
near 150 32 21.125 0.125
zoom 0 28.125 28.125 0.5
zoom 60 28.125 18 2
zoom 110 32 15.125 4.5
zoom 150 32 18 0.5)";

TEST(ObserverTest, hasTheChiSquareValuesOfTheArticle) {
    const Observer observer("paper", published());
    std::istringstream rows(table_ii);
    std::string distance;
    int azimuth_deg = 0;
    int values = 0;
    while (rows >> distance >> azimuth_deg) {
        for (const char* test : {"no_sss", "ss_jittered", "ss_full"}) {
            double chi_square = 0;
            rows >> chi_square;
            const double excess = 32 * observer.reference_proportion(test, distance, azimuth_deg) - 16;
            EXPECT_GE(excess, 0) << test << distance << azimuth_deg;
            // Counts are whole and the sum is exact in binary.
            EXPECT_EQ(2 * excess * excess / 16, chi_square) << test << " " << distance << " " << azimuth_deg;
            ++values;
        }
    }
    EXPECT_EQ(values, 36);
}

TEST(ObserverTest, tossesAFairCoinAsNull) {
    EXPECT_EQ(Observer("null", published()).reference_proportion("ss_full", "zoom", 110), 0.5);
}

TEST(ObserverTest, followsTheLastEntryOfAFileThatMatches) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "o.toml",
                   "default = 0.6\n"
                   "[[condition]]\ntest = \"no_sss\"\nreference_proportion = 0.9\n"
                   "[[condition]]\ndistance = \"far\"\nreference_proportion = 0.7\n"
                   "[[condition]]\ntest = \"no_sss\"\ndistance = \"far\"\nazimuth_deg = 60\n"
                   "reference_proportion = 0.0\n");
    const Observer observer((folder / "o.toml").string(), published());
    EXPECT_EQ(observer.reference_proportion("ss_full", "near", 0), 0.6);
    EXPECT_EQ(observer.reference_proportion("no_sss", "near", 0), 0.9);
    EXPECT_EQ(observer.reference_proportion("no_sss", "far", 0), 0.7);
    EXPECT_EQ(observer.reference_proportion("no_sss", "far", 60), 0.0);
}

TEST(ObserverTest, namesFileLineAndFieldOfAWrongFile) {
    EXPECT_NE(message_of("default = 1.5").find("o.toml:1: default: expected a number from 0 to 1, found 1.5"),
              std::string::npos);
    EXPECT_NE(message_of("[[condition]]\ntest = \"no_sss\"").find("condition[0].reference_proportion"),
              std::string::npos);
    EXPECT_NE(message_of("[[condition]]\nreference_proportion = nan").find("found nan"), std::string::npos);
    EXPECT_NE(message_of("[[condition]]\ntest = \"tss\"\nreference_proportion = 1").find("found \"tss\""),
              std::string::npos);
    EXPECT_NE(message_of("[[condition]]\nazimuth_deg = 61\nreference_proportion = 1").find("found 61"),
              std::string::npos);
    EXPECT_NE(message_of("lapse = 0.1").find("unknown field"), std::string::npos);
    EXPECT_THROW(Observer("/nowhere/o.toml", published()), support::InputError);
}

TEST(ObserverTest, refusesConditionsThatTheArticleDidNotMeasure) {
    study::Protocol protocol = published();
    protocol.light.azimuths_deg.push_back(90);
    EXPECT_THROW(Observer("paper", protocol), support::InputError);
    study::Protocol other_reference = published();
    other_reference.session.reference = "no_sss";
    EXPECT_THROW(Observer("paper", other_reference), support::InputError);
}

TEST(SimulatedStageTest, choosesTheReferenceAsOftenAsItsObserverDoes) {
    const Observer observer("paper", published());
    const double proportion = observer.reference_proportion("ss_full", "zoom", 110); // 22/32
    constexpr int trials = 4000;
    int chosen = 0;
    for (int i = 0; i < trials; ++i) {
        // A participant answers a pair alike each time, so each trial has one of its own.
        experiment::SimulatedStage stage(observer, static_cast<std::uint64_t>(i));
        const bool reference_first = i % 2 == 0;
        stage.show(experiment::Stimulus{reference_first ? "ts" : "ss_full", "zoom", 110});
        stage.show(experiment::Grey{});
        stage.show_after(2, experiment::Stimulus{reference_first ? "ss_full" : "ts", "zoom", 110});
        const auto press = stage.wait_for({experiment::Key::one, experiment::Key::two});
        chosen += (press.key == experiment::Key::one) == reference_first ? 1 : 0;
    }
    // Binomial: the bound of five standard deviations is passed by chance once in two million seeds.
    EXPECT_NEAR(chosen, trials * proportion, 5 * std::sqrt(trials * proportion * (1 - proportion)));
}

/// How often participants of a file's kind press 1 where the reference is shown first, and where it is
/// second.
std::array<double, 2> first_key_shares(const std::string& toml, int participants) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "o.toml", toml);
    const Observer observer((folder / "o.toml").string(), published());
    std::array<double, 2> shares{};
    for (int i = 0; i < participants; ++i) {
        experiment::SimulatedStage stage(observer, static_cast<std::uint64_t>(i));
        for (const std::size_t order : {0U, 1U}) {
            stage.show(experiment::Stimulus{order == 0 ? "ts" : "ss_full", "near", 0});
            stage.show(experiment::Stimulus{order == 0 ? "ss_full" : "ts", "near", 0});
            const auto press = stage.wait_for({experiment::Key::one, experiment::Key::two});
            shares[order] += press.key == experiment::Key::one ? 1.0 / participants : 0;
        }
    }
    return shares;
}

constexpr int participants = 4000;
constexpr double five_sd = 5 * 0.5 / 63.2; // of a share of 4000 answers, at most; passed once in two million

TEST(SimulatedStageTest, lapsesAsOftenAsTheFileSays) {
    // Certain of the reference but for a tenth of tosses: 0.9 + 0.1 / 2.
    const auto shares = first_key_shares("default = 1\nlapse_rate = 0.1", participants);
    EXPECT_NEAR(shares[0], 0.95, five_sd);
    EXPECT_NEAR(shares[1], 0.05, five_sd);
}

TEST(SimulatedStageTest, favoursThePictureOfItsBias) {
    // Odds of 3 for the first picture, by bias alone, then with even odds of 4 for the reference: 12 and 3/4.
    EXPECT_NEAR(first_key_shares("interval_bias = 1.0986122886681098", participants)[0], 0.75, five_sd);
    const auto both = first_key_shares("default = 0.8\ninterval_bias = 1.0986122886681098", participants);
    EXPECT_NEAR(both[0], 12.0 / 13, five_sd);
    EXPECT_NEAR(both[1], 3.0 / 7, five_sd);
}

TEST(SimulatedStageTest, differsBetweenParticipantsByTheSpread) {
    // With so large a spread a participant is all but certain, one way or the other: both orders agree.
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "o.toml", "spread = 100");
    const Observer observer((folder / "o.toml").string(), published());
    int same = 0;
    int reference = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        experiment::SimulatedStage stage(observer, seed);
        std::array<bool, 2> chose_reference{};
        for (const std::size_t order : {0U, 1U}) {
            stage.show(experiment::Stimulus{order == 0 ? "ts" : "ss_full", "near", 0});
            stage.show(experiment::Stimulus{order == 0 ? "ss_full" : "ts", "near", 0});
            const auto press = stage.wait_for({experiment::Key::one, experiment::Key::two});
            chose_reference[order] = (press.key == experiment::Key::one) == (order == 0);
        }
        same += chose_reference[0] == chose_reference[1] ? 1 : 0;
        reference += chose_reference[0] ? 1 : 0;
    }
    // |N(0, 100)| is below 5, where answers may differ, with a probability of 0.04: 16 of 400, and five SD
    // of 4.
    EXPECT_GT(same, 400 - 36);
    EXPECT_NEAR(reference, 200, 50);
}

TEST(SimulatedStageTest, takesTheTimesOfTheFile) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "o.toml", "[response_time]\nmedian_s = 7\nlog_sd = 0");
    experiment::SimulatedStage stage(Observer((folder / "o.toml").string(), published()), 1);
    stage.show(experiment::Stimulus{"ts", "near", 0});
    const double onset_s = stage.show(experiment::Stimulus{"no_sss", "near", 0});
    EXPECT_DOUBLE_EQ(stage.wait_for({experiment::Key::one, experiment::Key::two}).time_s - onset_s, 7);
}

TEST(SimulatedStageTest, hasCertainObserversAnswerWithoutFail) {
    const fixture::TemporaryFolder folder;
    fixture::write(folder / "o.toml",
                   "default = 1\n[[condition]]\ntest = \"no_sss\"\nreference_proportion = 0");
    experiment::SimulatedStage stage(Observer((folder / "o.toml").string(), published()), 3);
    for (int i = 0; i < 100; ++i) {
        stage.show(experiment::Stimulus{"ts", "near", 0});
        stage.show(experiment::Stimulus{"ss_full", "near", 0});
        EXPECT_EQ(stage.wait_for({experiment::Key::one, experiment::Key::two}).key, experiment::Key::one);
        stage.show(experiment::Stimulus{"ts", "near", 0});
        stage.show(experiment::Stimulus{"no_sss", "near", 0});
        EXPECT_EQ(stage.wait_for({experiment::Key::one, experiment::Key::two}).key, experiment::Key::two);
    }
}

} // namespace
