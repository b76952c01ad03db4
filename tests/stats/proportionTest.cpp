// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/proportion.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace {

using stats::binomial_two_sided_p;
using stats::chi_square_equal;
using stats::wilson_interval;

// Reference values are stored to 16 digits; a few dozen roundings of the incomplete beta and gamma functions.
constexpr double relative_tolerance = 1e-13;

void expect_relative(double found, double expected, double tolerance) {
    EXPECT_NEAR(found / expected, 1, tolerance) << found << " against " << expected;
}

/// C(n, k) in exact integers, for n up to 62.
std::uint64_t choose(int n, int k) {
    std::vector<std::uint64_t> row{1};
    for (int i = 0; i < n; ++i) {
        row.push_back(0);
        for (std::size_t j = row.size() - 1; j > 0; --j) {
            row[j] += row[j - 1];
        }
    }
    return row[static_cast<std::size_t>(k)];
}

// Closed forms: exp(-5/4) for two degrees of freedom, erfc(2) for one.
TEST(ProportionTest, chiSquareHasReferenceValues) {
    const auto three = chi_square_equal(std::array<std::int64_t, 3>{20, 15, 25});
    EXPECT_EQ(three.df, 2);
    EXPECT_DOUBLE_EQ(three.statistic, 2.5);
    expect_relative(three.p, 0.2865047968601901, relative_tolerance);
    const auto two = chi_square_equal(std::array<std::int64_t, 2>{48, 24});
    EXPECT_EQ(two.df, 1);
    EXPECT_DOUBLE_EQ(two.statistic, 8);
    expect_relative(two.p, 0.004677734981047265, relative_tolerance);
}

TEST(ProportionTest, chiSquareOfOneDegreeIsASquaredNormal) {
    // P(Z^2 > x) = erfc(sqrt(x / 2)); the last case lies near 1e-296, where 1 - cdf would be 0.
    for (const auto& [k, n] : {std::pair{17, 32}, {22, 32}, {32, 32}, {400, 500}, {1350, 1350}}) {
        const auto found = chi_square_equal(std::array<std::int64_t, 2>{k, n - k});
        const double statistic = std::pow(2.0 * k - n, 2) / n;
        EXPECT_NEAR(found.statistic, statistic, statistic * 1e-14);           // rounding of three operations
        expect_relative(found.p, std::erfc(std::sqrt(statistic / 2)), 1e-11); // x = 1350 magnifies rounding
        EXPECT_GT(found.p, 0);
    }
}

TEST(ProportionTest, chiSquareOfEqualCountsHasPOfOne) {
    const auto found = chi_square_equal(std::array<std::int64_t, 2>{16, 16});
    EXPECT_EQ(found.statistic, 0);
    EXPECT_EQ(found.p, 1);
}

TEST(ProportionTest, exactTestIsTheSumOverChoose) {
    // Half and half: the outcomes no more probable than k are those with C(n, i) <= C(n, k), counted exactly.
    for (int n = 1; n <= 60; ++n) {
        for (int k = 0; k <= n; ++k) {
            std::uint64_t extreme = 0;
            for (int i = 0; i <= n; ++i) {
                extreme += choose(n, i) <= choose(n, k) ? choose(n, i) : 0;
            }
            const double expected = std::ldexp(static_cast<double>(extreme), -n);
            // Boost's incomplete beta is good to a few dozen units in the last place.
            ASSERT_NEAR(binomial_two_sided_p(k, n) / expected, 1, 1e-13) << k << " of " << n;
        }
    }
}

// The values of R's binom.test(48, 72) and binom.test(682, 925, .75), summed in exact rational numbers.
TEST(ProportionTest, exactTestHasReferenceValues) {
    expect_relative(binomial_two_sided_p(48, 72), 0.006309827313666047, relative_tolerance);
    expect_relative(binomial_two_sided_p(682, 925, 0.75), 0.3824915595748517, relative_tolerance);
}

TEST(ProportionTest, exactTestOfUnequalOddsIsTheDirectSum) {
    // A naive sum of all terms, with R's tolerance; 1e-12 covers its 40 roundings and those of pow.
    const int n = 40;
    for (const double p0 : {0.1, 0.3, 0.75}) {
        std::vector<double> density;
        for (int i = 0; i <= n; ++i) {
            density.push_back(static_cast<double>(choose(n, i)) * std::pow(p0, i) * std::pow(1 - p0, n - i));
        }
        for (int k = 0; k <= n; ++k) {
            double expected = 0;
            for (const double d : density) {
                expected += d <= density[static_cast<std::size_t>(k)] * (1 + 1e-7) ? d : 0;
            }
            ASSERT_NEAR(binomial_two_sided_p(k, n, p0) / expected, 1, 1e-12) << k << ", p0 " << p0;
        }
    }
}

TEST(ProportionTest, exactTestHoldsAtTheExtremes) {
    EXPECT_EQ(binomial_two_sided_p(0, 0), 1);
    EXPECT_EQ(binomial_two_sided_p(1, 1), 1);
    EXPECT_DOUBLE_EQ(binomial_two_sided_p(0, 1000), std::ldexp(1, -999));
    EXPECT_DOUBLE_EQ(binomial_two_sided_p(1000, 1000), std::ldexp(1, -999));
    EXPECT_EQ(binomial_two_sided_p(500'000, 1'000'000), 1);
    // For a million trials the normal approximation with continuity correction is good to 1e-6 or so.
    expect_relative(binomial_two_sided_p(501'000, 1'000'000), std::erfc(999.5 / 500 / std::sqrt(2)), 1e-4);
}

// The interval of R's prop.test(15, 25, correct = FALSE), in 40-digit decimal numbers.
TEST(ProportionTest, wilsonHasReferenceValues) {
    const auto ci = wilson_interval(15, 25);
    expect_relative(ci.low, 0.4073945735896699, relative_tolerance);
    expect_relative(ci.high, 0.7659669762225204, relative_tolerance);
}

TEST(ProportionTest, wilsonBoundsSolveTheScoreEquation) {
    // At a bound x, |p - x| is 1.96 standard errors under x.
    const double z = 1.959963984540054;
    for (const auto& [k, n] : {std::pair{1, 32}, {16, 32}, {31, 32}, {1, 1'000'000}, {7, 9}}) {
        const auto ci = wilson_interval(k, n);
        const double p = static_cast<double>(k) / n;
        for (const double x : {ci.low, ci.high}) {
            // 1e-9: the difference p - x loses digits where n is large.
            EXPECT_NEAR(std::abs(p - x) / std::sqrt(x * (1 - x) / n), z, 1e-9) << k << " of " << n;
        }
        EXPECT_LT(ci.low, p);
        EXPECT_GT(ci.high, p);
    }
}

TEST(ProportionTest, wilsonStaysWithinZeroAndOne) {
    for (const std::int64_t n : {1, 2, 3, 10, 32, 999, 1'000'000}) {
        EXPECT_EQ(wilson_interval(0, n).low, 0);
        EXPECT_EQ(wilson_interval(n, n).high, 1);
        for (std::int64_t k = 0; k <= std::min<std::int64_t>(n, 40); ++k) {
            const auto ci = wilson_interval(k, n), mirrored = wilson_interval(n - k, n);
            EXPECT_TRUE(0 <= ci.low && ci.low < ci.high && ci.high <= 1) << k << " of " << n;
            EXPECT_NEAR(ci.low, 1 - mirrored.high, 1e-15); // one rounding of a number near 1
        }
    }
}

TEST(ProportionTest, impossibleCountsAreRefused) {
    EXPECT_THROW(chi_square_equal(std::array<std::int64_t, 2>{0, 0}), std::invalid_argument);
    EXPECT_THROW(chi_square_equal(std::array<std::int64_t, 2>{-1, 3}), std::invalid_argument);
    EXPECT_THROW(chi_square_equal(std::array<std::int64_t, 1>{3}), std::invalid_argument);
    EXPECT_THROW(binomial_two_sided_p(3, 2), std::invalid_argument);
    EXPECT_THROW(binomial_two_sided_p(1, 2, std::nan("")), std::invalid_argument);
    EXPECT_THROW(wilson_interval(0, 0), std::invalid_argument);
    EXPECT_THROW(wilson_interval(1, 2, 1), std::invalid_argument);
}

} // namespace
