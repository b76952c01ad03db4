// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// 2,000 simulated studies without any true preference: who cries wolf, and how often?

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <stats/mixed_model.h>
#include <stats/multiplicity.h>
#include <stats/order.h>
#include <stats/participant_test.h>
#include <stats/power.h>
#include <stats/proportion.h>
#include <support/random.h>

namespace {

constexpr int studies = 2000;
constexpr double level = 0.05;

/// Shares of the studies in which each test is significant.
struct Alarms {
    double pooled = 0, sign_flip = 0, t = 0, mixed = 0, heterogeneity = 0;
};

/// Participants with `trials` answers each, whose preference (a logit) is normal about none.
Alarms false_alarms(std::size_t participants, std::int64_t trials, double spread, std::uint64_t seed) {
    support::Generator generator("calibration", seed);
    Alarms alarms;
    const auto count = [](double& share, double p) { share += p <= level ? 1.0 / studies : 0; };
    for (int study = 0; study < studies; ++study) {
        std::vector<stats::Tally> tallies;
        stats::Tally all;
        for (std::size_t i = 0; i < participants; ++i) {
            const double p = 1 / (1 + std::exp(-spread * generator.normal()));
            tallies.push_back({trials, 0});
            for (std::int64_t trial = 0; trial < trials; ++trial) {
                tallies.back().reference_chosen += generator.uniform() < p ? 1 : 0;
            }
            all.n += trials;
            all.reference_chosen += tallies.back().reference_chosen;
        }
        count(alarms.pooled,
              stats::chi_square_equal(std::array{all.reference_chosen, all.n - all.reference_chosen}).p);
        count(alarms.sign_flip, stats::sign_flip(tallies).p);
        if (const auto test = stats::t_test(tallies)) {
            count(alarms.t, test->p);
        }
        if (const auto model = stats::fit_mixed_model(tallies)) {
            count(alarms.mixed, model->p);
            count(alarms.heterogeneity, model->p_heterogeneity);
        }
    }
    return alarms;
}

// The standard error of a share of .05 of 2,000 studies is .005; four of them either way.
constexpr double error = 0.02;

TEST(CalibrationTest, participantLevelTestsKeepTheirLevelWhereParticipantsDiffer) {
    // 10 participants with 72 trials; the pooled test's shares are known from simulations elsewhere: 21, 38
    // and 58 % at spreads of .3, .5 and 1.
    for (const auto& [spread, pooled] : {std::pair(0.3, 0.21), {0.5, 0.38}, {1.0, 0.58}}) {
        const Alarms alarms = false_alarms(10, 72, spread, 1);
        EXPECT_NEAR(alarms.sign_flip, level, error) << spread;
        EXPECT_NEAR(alarms.t, level, error) << spread;
        EXPECT_NEAR(alarms.pooled, pooled, 0.045) << spread; // four standard errors of .011
        // Wald's test of few participants is a little too eager: its z is a t of about 9 degrees of freedom.
        EXPECT_NEAR(alarms.mixed, level + 0.03, error + 0.01) << spread;
        EXPECT_GT(alarms.heterogeneity, level);
    }
}

TEST(CalibrationTest, wholeStudiesKeepTheMixedModelsLevel) {
    const Alarms alarms = false_alarms(60, 24, 0.7, 2);
    EXPECT_NEAR(alarms.mixed, level, error);
    EXPECT_NEAR(alarms.sign_flip, level, error);
    EXPECT_GT(alarms.pooled, 0.2);
}

TEST(CalibrationTest, withoutHeterogeneityNoTestExceedsItsLevel) {
    const Alarms alarms = false_alarms(30, 24, 0, 3);
    EXPECT_NEAR(alarms.pooled, level, error);
    EXPECT_LE(alarms.sign_flip, level + error); // ties make it a little timid
    EXPECT_GT(alarms.sign_flip, level - error);
    EXPECT_NEAR(alarms.t, level, error);
    EXPECT_NEAR(alarms.mixed, level, error);
    EXPECT_LE(alarms.heterogeneity, level + error); // the mixture is the limit for many participants
    EXPECT_GT(alarms.heterogeneity, 0.01);          // with thirty it is timid, but does reject
}

/// So many answers of a participant whose logit is normal about `logit`.
stats::Tally participant(support::Generator& generator, std::int64_t trials, double logit, double spread) {
    const double p = 1 / (1 + std::exp(-logit - spread * generator.normal()));
    stats::Tally tally{trials, 0};
    for (std::int64_t trial = 0; trial < trials; ++trial) {
        tally.reference_chosen += generator.uniform() < p ? 1 : 0;
    }
    return tally;
}

stats::Tally sum_of(const std::vector<stats::Tally>& tallies) {
    stats::Tally all;
    for (const stats::Tally& tally : tallies) {
        all.n += tally.n;
        all.reference_chosen += tally.reference_chosen;
    }
    return all;
}

TEST(CalibrationTest, equalityIsClaimedAtTheBoundNoMoreThanTheLevelAllows) {
    // The mean proportion is the upper bound itself, .65: a claim that it lies within is wrong.
    support::Generator generator("equivalence", 1);
    constexpr double spread = 0.7;
    const double logit = stats::median_logit(0.65, spread);
    double participants_err = 0, pooled_err = 0;
    for (int study = 0; study < studies; ++study) {
        std::vector<stats::Tally> tallies;
        for (int i = 0; i < 20; ++i) {
            tallies.push_back(participant(generator, 36, logit, spread));
        }
        const stats::Tally all = sum_of(tallies);
        participants_err += stats::equivalence_t_test(tallies).value() <= level ? 1.0 / studies : 0;
        pooled_err += stats::equivalence_p(all.reference_chosen, all.n) <= level ? 1.0 / studies : 0;
    }
    EXPECT_NEAR(participants_err, level, error);
    EXPECT_GT(pooled_err, 2 * level); // as if independent, it claims far too much
}

TEST(CalibrationTest, theParticipantsIntervalCoversAndThePooledDoesNot) {
    // 10 participants with 72 trials; Wilson's coverage is known from simulations elsewhere: 64 and 41 %.
    for (const auto& [spread, pooled] : {std::pair(0.5, 0.64), {1.0, 0.41}}) {
        support::Generator generator("coverage", 1);
        double covers = 0, wilson_covers = 0;
        const auto count = [](double& share, const stats::Interval& ci) {
            share += ci.low <= 0.5 && 0.5 <= ci.high ? 1.0 / studies : 0;
        };
        for (int study = 0; study < studies; ++study) {
            std::vector<stats::Tally> tallies;
            for (int i = 0; i < 10; ++i) {
                tallies.push_back(participant(generator, 72, 0, spread));
            }
            const stats::Tally all = sum_of(tallies);
            count(covers, stats::mean_interval(tallies).value().ci);
            count(wilson_covers, stats::wilson_interval(all.reference_chosen, all.n));
        }
        EXPECT_NEAR(covers, 1 - level, error) << spread;
        EXPECT_NEAR(wilson_covers, pooled, 0.045) << spread; // four standard errors of .011
    }
}

TEST(CalibrationTest, theTestOfOrderKeepsItsLevelWherePreferencesAndHabitsDiffer) {
    // Each participant has a preference and a habit of their own; the habits have no mean.
    support::Generator generator("order", 1);
    double participants_err = 0, pooled_err = 0;
    for (int study = 0; study < studies; ++study) {
        std::vector<stats::Tally> surpluses;
        std::int64_t first_chosen = 0;
        for (int i = 0; i < 16; ++i) {
            const double preference = 1 + generator.normal(), habit = 0.7 * generator.normal();
            const stats::OrderTally tally{participant(generator, 36, preference + habit, 0),
                                          participant(generator, 36, preference - habit, 0)};
            surpluses.push_back(stats::first_interval(std::vector{tally}));
            first_chosen += tally.first_chosen();
        }
        participants_err += stats::order_bias(surpluses).value().sign_flip.p <= level ? 1.0 / studies : 0;
        pooled_err += stats::binomial_two_sided_p(first_chosen, 16 * 72) <= level ? 1.0 / studies : 0;
    }
    EXPECT_NEAR(participants_err, level, error);
    EXPECT_GT(pooled_err, 0.2);
}

TEST(CalibrationTest, holmsMethodKeepsTheFamilysLevel) {
    // Twelve tests without a difference: without a correction, 1 - .95^12 = 46 % of studies find one.
    support::Generator generator("family", 1);
    double any = 0, any_corrected = 0;
    for (int study = 0; study < studies; ++study) {
        std::vector<double> p;
        for (int test = 0; test < 12; ++test) {
            std::vector<stats::Tally> tallies;
            for (int i = 0; i < 16; ++i) {
                tallies.push_back(participant(generator, 36, 0, 0.5));
            }
            p.push_back(stats::sign_flip(tallies).p);
        }
        const auto corrected = stats::holm(p);
        any += *std::min_element(p.begin(), p.end()) <= level ? 1.0 / studies : 0;
        any_corrected += *std::min_element(corrected.begin(), corrected.end()) <= level ? 1.0 / studies : 0;
    }
    EXPECT_NEAR(any, 0.46, 0.06); // four errors of .011, and ties make it a little timid
    EXPECT_LE(any_corrected, level + error);
    EXPECT_GT(any_corrected, 0.01);
}

} // namespace
