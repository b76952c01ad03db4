// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>

namespace stats {

/// Outcome of the rank-sum test.
struct RankSum {
    double w = 0; ///< Mann and Whitney's statistic of the first group: pairs it exceeds, ties count a half
    double p = 1; ///< two-sided
    bool exact = true;
};

/// Rank-sum test of two groups of values [MannWhitney1947], ties at their mean ranks: over all ways to split
/// the values, the share whose rank sum lies as far from its mean as the observed one, or farther. Where
/// there are too many, the normal approximation with the correction for ties, without one for continuity.
/// Nothing where a group is empty.
std::optional<RankSum> rank_sum_test(std::span<const double> first, std::span<const double> second);

/// Welch's t-test of two groups' means [Welch1947].
struct WelchTest {
    double t = 0, df = 0, p = 1;
};

/// Nothing where a group has fewer than two values, or neither group varies.
std::optional<WelchTest> welch_test(std::span<const double> first, std::span<const double> second);

/// Quantile of values by linear interpolation between order statistics [HyndmanFan1996, type 7], as R has it.
/// 0 <= share <= 1; not a number without values.
double quantile(std::span<const double> sorted, double share);

} // namespace stats
