// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/two_groups.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <support/random.h>

namespace {

using Values = std::vector<double>;

/// Mann and Whitney's count: pairs in which the first group's value is larger; ties count a half.
double pairs_won(const Values& first, const Values& second) {
    double won = 0;
    for (const double a : first) {
        for (const double b : second) {
            won += a > b ? 1 : a == b ? 0.5 : 0;
        }
    }
    return won;
}

TEST(TwoGroupsTest, rankSumIsTheShareOfAllSplits) {
    support::Generator generator("two groups", 1);
    for (int i = 0; i < 40; ++i) {
        Values values(3 + generator.below(9));
        for (double& value : values) {
            value = static_cast<double>(generator.below(6)); // many ties
        }
        const std::size_t m = 1 + generator.below(values.size() - 1);
        const Values first(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(m)),
            second(values.begin() + static_cast<std::ptrdiff_t>(m), values.end());
        const auto found = stats::rank_sum_test(first, second).value();
        EXPECT_TRUE(found.exact);
        EXPECT_EQ(found.w, pairs_won(first, second));

        // All ways to choose the first group.
        const double middle = static_cast<double>(first.size() * second.size()) / 2;
        int far = 0, all = 0;
        std::vector<bool> in_first(values.size());
        std::fill(in_first.end() - static_cast<std::ptrdiff_t>(m), in_first.end(), true);
        do {
            Values a, b;
            for (std::size_t j = 0; j < values.size(); ++j) {
                (in_first[j] ? a : b).push_back(values[j]);
            }
            ++all;
            far += std::abs(pairs_won(a, b) - middle) >= std::abs(found.w - middle) ? 1 : 0;
        } while (std::next_permutation(in_first.begin(), in_first.end()));
        EXPECT_NEAR(found.p, static_cast<double>(far) / all, 1e-13) << i;
    }
}

TEST(TwoGroupsTest, completeSeparationIsTheRarestSplit) {
    // 2 of the 20 ways to choose 3 of 6.
    EXPECT_NEAR(stats::rank_sum_test(Values{1, 2, 3}, Values{4, 5, 6}).value().p, 0.1, 1e-15);
    EXPECT_EQ(stats::rank_sum_test(Values{4, 4}, Values{4, 4, 4}).value().p, 1);
    EXPECT_FALSE(stats::rank_sum_test(Values{}, Values{1}));
}

TEST(TwoGroupsTest, largeGroupsTakeTheNormalApproximation) {
    // Without a correction for continuity the approximation is off by half a step of the exact distribution.
    support::Generator generator("two groups", 2);
    Values first(50), second(50);
    for (double& value : first) {
        value = generator.normal() + 0.35;
    }
    for (double& value : second) {
        value = generator.normal();
    }
    const auto exact = stats::rank_sum_test(first, second).value();
    ASSERT_TRUE(exact.exact);
    const double z = std::abs(exact.w - 1250) / std::sqrt(50.0 * 50 * 101 / 12);
    EXPECT_NEAR(exact.p, std::erfc(z / std::sqrt(2)), 5e-3);
    Values large(400);
    for (double& value : large) {
        value = generator.normal();
    }
    EXPECT_FALSE(stats::rank_sum_test(large, large).value().exact);
    EXPECT_NEAR(stats::rank_sum_test(large, large).value().p, 1, 1e-12);
}

TEST(TwoGroupsTest, welchIsSymmetricAndNeedsSpread) {
    const Values a{1, 4, 2, 8}, b{3, 9, 7};
    const auto one = stats::welch_test(a, b).value(), other = stats::welch_test(b, a).value();
    EXPECT_EQ(one.t, -other.t);
    EXPECT_EQ(one.p, other.p);
    EXPECT_FALSE(stats::welch_test(Values{1}, b));
    EXPECT_FALSE(stats::welch_test(Values{2, 2}, Values{3, 3}));
    // Equal sizes and spreads: Student's degrees of freedom.
    EXPECT_NEAR(stats::welch_test(Values{1, 2, 3}, Values{4, 5, 6}).value().df, 4, 1e-12);
}

TEST(TwoGroupsTest, quantilesLieBetweenTheValues) {
    EXPECT_EQ(stats::quantile(Values{3}, 0.25), 3);
    EXPECT_EQ(stats::quantile(Values{1, 2}, 0.5), 1.5);
    EXPECT_EQ(stats::quantile(Values{1, 2, 10}, 1), 10);
    EXPECT_TRUE(std::isnan(stats::quantile(Values{}, 0.5)));
}

} // namespace
