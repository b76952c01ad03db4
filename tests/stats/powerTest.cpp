// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/power.h>

#include <cmath>

#include <gtest/gtest.h>

#include <stats/proportion.h>

#include "power_report.h"

namespace {

using namespace stats;

/// The definition: the probabilities of all counts that the exact test calls significant.
double power_by_definition(std::int64_t n, double p, double level) {
    double power = 0;
    for (std::int64_t k = 0; k <= n; ++k) {
        const auto x = static_cast<double>(k), m = static_cast<double>(n);
        const double probability = std::exp(std::lgamma(m + 1) - std::lgamma(x + 1) - std::lgamma(m - x + 1) +
                                            x * std::log(p) + (m - x) * std::log1p(-p));
        power += binomial_two_sided_p(k, n) <= level ? probability : 0;
    }
    return power;
}

TEST(PowerTest, isTheProbabilityOfTheSignificantCounts) {
    for (const std::int64_t n : {1, 5, 6, 17, 72, 301}) {
        for (const double p : {0.5, 0.58, 0.93}) {
            EXPECT_NEAR(exact_power(n, p, 0.05), power_by_definition(n, p, 0.05), 1e-11)
                << n << " " << p; // lgamma
        }
    }
    EXPECT_EQ(exact_power(0, 0.7, 0.05), 0);
    EXPECT_EQ(exact_power(5, 1, 0.05), 0); // 2 / 32 is more than .05
    EXPECT_EQ(exact_power(6, 1, 0.05), 1);
}

TEST(PowerTest, falseAlarmsNeverExceedTheLevel) {
    for (std::int64_t n = 1; n < 300; ++n) {
        EXPECT_LE(exact_power(n, 0.5, 0.05), 0.05) << n;
    }
}

TEST(PowerTest, trialsNeededAreEnoughFromThereOn) {
    for (const double p : {0.6, 0.65, 0.7, 0.75, 0.95, 1.0}) {
        const std::int64_t n = trials_needed(p, 0.8, 0.05);
        EXPECT_LT(exact_power(n - 1, p, 0.05), 0.8) << p;
        for (std::int64_t more = n; more < n + 400; ++more) {
            ASSERT_GE(exact_power(more, p, 0.05), 0.8) << p << " " << more;
        }
    }
    EXPECT_EQ(trials_needed(0.6, 0.8, 0.05), 210);
    EXPECT_EQ(trials_needed(0.75, 0.8, 0.05), 35);
}

TEST(PowerTest, theDetectableProportionHasJustThePower) {
    for (const std::int64_t n : {10, 32, 384, 100'000}) {
        EXPECT_NEAR(exact_power(n, detectable_proportion(n, 0.8, 0.05), 0.05), 0.8, 1e-9) << n;
    }
    EXPECT_TRUE(std::isnan(detectable_proportion(5, 0.8, 0.05)));
}

TEST(PowerTest, medianLogitGivesTheMeanProportion) {
    EXPECT_NEAR(median_logit(0.65, 0), std::log(0.65 / 0.35), 1e-12);
    EXPECT_NEAR(median_logit(0.5, 2), 0, 1e-12);
    EXPECT_GT(median_logit(0.65, 2), median_logit(0.65, 1)); // the mean is drawn to one half
}

TEST(PowerTest, oneTrialEachSimulatesTheExactTest) {
    // With one answer a participant the sign-flip test is the binomial test.
    const auto found = simulated_power({40, 1, 0.7, 0}, 0.05, 4000, 1);
    EXPECT_NEAR(found.participant_level, exact_power(40, 0.7, 0.05), 4.5 * found.standard_error);
    const auto again = simulated_power({40, 1, 0.7, 0}, 0.05, 4000, 1);
    EXPECT_EQ(again.participant_level, found.participant_level);
}

TEST(PowerTest, noStudyNeedsFewerThanSixParticipants) {
    // 54 answers find a proportion of .7: three participants of 24, who cannot be significant as a sample.
    PowerPlan plan;
    plan.studies = 100;
    const std::string text = power_report(plan).text;
    const auto line = text.find("\n         0.7 ");
    ASSERT_NE(line, std::string::npos) << text;
    EXPECT_NE(text.substr(line, 70).find("54                 6\n"), std::string::npos)
        << text.substr(line, 70);
}

TEST(PowerTest, theReportHasTableAndCurve) {
    PowerPlan plan;
    plan.studies = 100;
    plan.spreads = {0, 1};
    const PowerReport report = power_report(plan);
    EXPECT_NE(report.text.find("16 participants x 24 trials = 384 answers"), std::string::npos);
    EXPECT_NE(report.text.find("  210  "), std::string::npos)
        << report.text; // answers for a proportion of .6
    EXPECT_EQ(std::count(report.tsv.begin(), report.tsv.end(), '\n'), 1 + 2 * 10);
    EXPECT_NE(report.svg.find("spread 1"), std::string::npos);
}

} // namespace
