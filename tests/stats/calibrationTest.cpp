// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// 2,000 simulated studies without any true preference: who cries wolf, and how often?

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <stats/mixed_model.h>
#include <stats/participant_test.h>
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
    EXPECT_NEAR(alarms.t, level, error);
    EXPECT_NEAR(alarms.mixed, level, error);
    EXPECT_LE(alarms.heterogeneity, level + error); // the mixture is the limit for many participants
}

} // namespace
