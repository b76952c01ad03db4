// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/equivalence.h>

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace {

using stats::equivalence_p;
using stats::log_bayes_factor_01;

/// n over k in whole numbers, exact up to n = 60.
std::uint64_t choose(int n, int k) {
    std::uint64_t result = 1;
    for (int i = 1; i <= k; ++i) {
        result = result * static_cast<std::uint64_t>(n - k + i) / static_cast<std::uint64_t>(i);
    }
    return result;
}

double probability(int k, int n, double p) {
    return static_cast<double>(choose(n, k)) * std::pow(p, k) * std::pow(1 - p, n - k);
}

TEST(EquivalenceTest, hasTheKnownValues) {
    EXPECT_NEAR(equivalence_p(36, 72) / 0.00627501642326, 1, 1e-11); // as many digits as are known
    EXPECT_NEAR(std::exp(-log_bayes_factor_01(48, 72)) / 8.13683304646526, 1, 1e-12);
    EXPECT_NEAR(std::exp(log_bayes_factor_01(36, 72)) / 6.84051429667509, 1, 1e-12);
}

TEST(EquivalenceTest, isTheLargerOfTwoSums) {
    for (const int n : {1, 7, 32, 60}) {
        for (int k = 0; k <= n; ++k) {
            double at_least = 0, at_most = 0;
            for (int i = 0; i <= n; ++i) {
                at_least += i >= k ? probability(i, n, 0.3) : 0;
                at_most += i <= k ? probability(i, n, 0.6) : 0;
            }
            EXPECT_NEAR(equivalence_p(k, n, {0.3, 0.6}) / std::max(at_least, at_most), 1, 1e-12)
                << k << " of " << n;
        }
    }
}

TEST(EquivalenceTest, isSymmetricAndNeverShownByTheEnds) {
    for (int k = 0; k <= 40; ++k) {
        EXPECT_NEAR(equivalence_p(k, 40) / equivalence_p(40 - k, 40), 1, 1e-12);
    }
    EXPECT_EQ(equivalence_p(0, 1'000'000), 1);
    EXPECT_EQ(equivalence_p(0, 0), 1);
    EXPECT_EQ(equivalence_p(1'000'000, 1'000'000), 1);
    EXPECT_LT(equivalence_p(500'000, 1'000'000), 1e-300);
    EXPECT_THROW(equivalence_p(3, 2), std::invalid_argument);
    EXPECT_THROW(equivalence_p(1, 2, {0.6, 0.4}), std::invalid_argument);
    EXPECT_THROW(equivalence_p(1, 2, {0, 0.4}), std::invalid_argument);
}

TEST(EquivalenceTest, bayesFactorAveragesToOneUnderEitherHypothesis) {
    // The mean of BF10 is 1 if there is no preference, and that of BF01 is 1 under the prior.
    for (const int n : {0, 1, 8, 33, 60}) {
        double under_none = 0, under_prior = 0;
        for (int k = 0; k <= n; ++k) {
            under_none += std::exp(-log_bayes_factor_01(k, n)) * probability(k, n, 0.5);
            under_prior += std::exp(log_bayes_factor_01(k, n)) / (n + 1);
        }
        EXPECT_NEAR(under_none, 1, 1e-12) << n;
        EXPECT_NEAR(under_prior, 1, 1e-12) << n;
    }
}

TEST(EquivalenceTest, bayesFactorHoldsAtTheExtremes) {
    EXPECT_EQ(log_bayes_factor_01(0, 0), 0);
    // (n + 1) / 2^n
    EXPECT_NEAR(log_bayes_factor_01(0, 1'000'000), std::log(1'000'001.0) - 1'000'000 * std::log(2.0), 1e-6);
    // Stirling's: (n + 1) sqrt(2 / (pi n)), to 1 in 4 n.
    EXPECT_NEAR(log_bayes_factor_01(500'000, 1'000'000),
                std::log(1'000'001 * std::sqrt(2 / (3.14159265358979 * 1e6))), 1e-6);
    EXPECT_THROW(log_bayes_factor_01(-1, 2), std::invalid_argument);
}

} // namespace
