// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/mixed_model.h>

#include <cmath>

#include <gtest/gtest.h>

namespace {

using stats::fit_mixed_model;
using stats::Tally;
using Tallies = std::vector<Tally>;

const Tallies example{{18, 17}, {18, 4},  {18, 15}, {18, 6},  {18, 18},
                      {18, 9},  {18, 16}, {18, 5},  {18, 14}, {18, 12}};

/// The log-likelihood by the trapezoidal rule, which is exact to rounding for so smooth a function.
double naive_log_likelihood(const Tallies& tallies, double intercept, double sd) {
    constexpr double step = 0.01, reach = 10, pi = 3.14159265358979323846;
    double sum = 0;
    for (const auto& [n, k] : tallies) {
        double integral = 0;
        for (double u = -reach; u <= reach; u += step) {
            const double p = 1 / (1 + std::exp(-intercept - sd * u));
            integral += step * std::pow(p, static_cast<double>(k)) *
                        std::pow(1 - p, static_cast<double>(n - k)) * std::exp(-u * u / 2) /
                        std::sqrt(2 * pi);
        }
        sum += std::log(integral);
    }
    return sum;
}

TEST(MixedModelTest, quadratureIntegratesTheNormalsMoments) {
    for (const int points : {1, 2, 7, 25, stats::quadrature_points}) {
        const auto [nodes, weights] = stats::normal_quadrature(points);
        ASSERT_EQ(nodes.size(), static_cast<std::size_t>(points));
        double moment = 1; // 1, 1, 3, 15, ...: (2j - 1)!!
        for (int j = 0; 2 * j < 2 * points && j < 8; ++j) {
            double even = 0, odd = 0;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                even += weights[i] * std::pow(nodes[i], 2 * j);
                odd += weights[i] * std::pow(nodes[i], 2 * j + 1);
            }
            EXPECT_NEAR(even / moment, 1, 1e-11) << points << ", degree " << 2 * j; // sums of large terms
            EXPECT_NEAR(odd / moment, 0, 1e-10) << points << ", degree " << 2 * j + 1;
            moment *= 2 * j + 1;
        }
    }
}

TEST(MixedModelTest, hasTheKnownEstimate) {
    const auto model = fit_mixed_model(example).value();
    EXPECT_NEAR(model.intercept, 0.8867, 5e-5); // as printed
    EXPECT_NEAR(model.standard_error, 0.5231, 5e-5);
    EXPECT_GE(stats::quadrature_points, 25);
}

TEST(MixedModelTest, theEstimateIsTheTopOfTheLikelihood) {
    for (const Tallies& tallies :
         {example, Tallies{{2, 2}, {2, 1}, {2, 2}, {2, 0}, {2, 1}, {2, 2}, {2, 2}, {2, 2}}}) {
        const auto model = fit_mixed_model(tallies).value();
        ASSERT_GT(model.sd, 0);
        const auto at = [&](double b, double s) { return naive_log_likelihood(tallies, b, s); };
        const double top = at(model.intercept, model.sd), d = 1e-3;
        EXPECT_NEAR(model.log_likelihood, top, 1e-9);
        const double b = model.intercept, s = model.sd;
        // Differences over 1e-3: errors of 1e-6 and less, from the third derivatives.
        EXPECT_NEAR((at(b + d, s) - at(b - d, s)) / (2 * d), 0, 1e-5);
        EXPECT_NEAR((at(b, s + d) - at(b, s - d)) / (2 * d), 0, 1e-5);
        const double bb = (at(b + d, s) - 2 * top + at(b - d, s)) / (d * d);
        const double ss = (at(b, s + d) - 2 * top + at(b, s - d)) / (d * d);
        const double bs =
            (at(b + d, s + d) - at(b + d, s - d) - at(b - d, s + d) + at(b - d, s - d)) / (4 * d * d);
        EXPECT_NEAR(model.standard_error, std::sqrt(-ss / (bb * ss - bs * bs)), 1e-5 * model.standard_error);
    }
}

TEST(MixedModelTest, participantsAlikeGiveThePooledEstimate) {
    const auto model = fit_mixed_model(Tallies(9, {24, 15})).value();
    EXPECT_EQ(model.sd, 0);
    EXPECT_EQ(model.p_heterogeneity, 1);
    EXPECT_NEAR(model.intercept, std::log(15.0 / 9), 1e-12);
    EXPECT_NEAR(model.standard_error, 1 / std::sqrt(9 * 24 * (15.0 / 24) * (9.0 / 24)), 1e-12);
}

TEST(MixedModelTest, aSlightSpreadIsFound) {
    // Sixteen participants whose answers spread a trace more than a binomial's: the top lies just off sd = 0.
    Tallies tallies;
    for (const std::int64_t k : {4, 5, 4, 7, 7, 5, 6, 7, 7, 5, 4, 7, 4, 7, 4, 4}) {
        tallies.push_back({8, k});
    }
    const auto model = fit_mixed_model(tallies).value();
    EXPECT_GT(model.sd, 0.01);
    EXPECT_LT(model.sd, 0.1);
    EXPECT_GE(model.log_likelihood, naive_log_likelihood(tallies, model.intercept, 0) - 1e-9);
    EXPECT_LE(model.p_heterogeneity, 0.5); // half the probability lies on sd = 0
}

TEST(MixedModelTest, twiceTheParticipantsHalveTheVariance) {
    Tallies twice = example;
    twice.insert(twice.end(), example.begin(), example.end());
    const auto once = fit_mixed_model(example).value(), both = fit_mixed_model(twice).value();
    EXPECT_NEAR(both.intercept, once.intercept, 1e-9);
    EXPECT_NEAR(both.sd, once.sd, 1e-9);
    EXPECT_NEAR(both.standard_error, once.standard_error / std::sqrt(2), 1e-9);
    EXPECT_NEAR(both.log_likelihood, 2 * once.log_likelihood, 1e-9);
}

TEST(MixedModelTest, theOtherShaderHasTheOppositeEstimate) {
    Tallies mirrored;
    for (const Tally& tally : example) {
        mirrored.push_back({tally.n, tally.n - tally.reference_chosen});
    }
    const auto model = fit_mixed_model(example).value(), opposite = fit_mixed_model(mirrored).value();
    EXPECT_NEAR(opposite.intercept, -model.intercept, 1e-9);
    EXPECT_NEAR(opposite.sd, model.sd, 1e-9);
    EXPECT_NEAR(opposite.p, model.p, 1e-9);
}

TEST(MixedModelTest, participantsOfOneMindDoNotHideTheSummit) {
    // Six of nine always chose the reference, one never: steep, but with a summit. R: the likelihood summed
    // in steps of .01 over u in [-12, 12], its top by optim() and its curvature by optimHess().
    const Tallies extreme{{6, 6}, {6, 6}, {1, 1}, {6, 5}, {1, 1}, {6, 6}, {6, 0}, {6, 6}, {6, 6}};
    const auto model = fit_mixed_model(extreme).value();
    EXPECT_NEAR(model.intercept, 7.557, 5e-4);
    EXPECT_NEAR(model.sd, 7.192, 5e-4);
    EXPECT_NEAR(model.standard_error, 6.594, 5e-4);
    EXPECT_NEAR(model.log_likelihood, -8.893, 5e-4);
    EXPECT_NEAR(model.log_likelihood, naive_log_likelihood(extreme, model.intercept, model.sd), 1e-9);
}

TEST(MixedModelTest, aSteepParticipantsPeakIsFound) {
    // Of nine, only one wavers: the spread is vast. R, as above: 5.99073, 10.795, 22.73836.
    const Tallies steep{{24, 24}, {24, 7}, {24, 24}, {13, 13}, {24, 0}, {23, 0}, {24, 0}, {5, 5}, {4, 4}};
    const auto model = fit_mixed_model(steep).value();
    EXPECT_NEAR(model.intercept, 5.99073, 1e-3);
    EXPECT_NEAR(model.standard_error, 10.795, 1e-2); // numerical derivatives
    EXPECT_NEAR(model.sd, 22.73836, 1e-3);
}

TEST(MixedModelTest, whatHasNoEstimateGivesNone) {
    EXPECT_FALSE(fit_mixed_model({}));
    EXPECT_FALSE(fit_mixed_model(Tallies{{18, 9}}));                // one participant
    EXPECT_FALSE(fit_mixed_model(Tallies(10, {18, 18})));           // always the reference
    EXPECT_FALSE(fit_mixed_model(Tallies{{1, 1}, {1, 0}, {1, 1}})); // sd changes nothing
    EXPECT_FALSE(fit_mixed_model(Tallies{{9, 9}, {9, 0}, {9, 9}})); // sd grows for ever
    EXPECT_FALSE(fit_mixed_model(Tallies{{0, 0}, {0, 0}, {18, 9}}));
}

} // namespace
