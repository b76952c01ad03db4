// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

namespace stats {

/// A chi-square statistic with its degrees of freedom and the probability of one at least as large.
struct ChiSquare {
    double statistic = 0;
    int df = 0;
    double p = 1;
};

/// One-sample chi-square of counts against equal expected counts, without continuity correction
/// [Pearson1900]. Needs two counts or more, none negative, not all 0 (std::invalid_argument).
ChiSquare chi_square_equal(std::span<const std::int64_t> observed);

/// Exact two-sided binomial test: the probability, under success probability p0, of all outcomes that are no
/// more probable than the observed one, with R's relative tolerance of 1e-7 [RCore2022, binom.test].
/// Needs 0 <= successes <= trials and 0 < p0 < 1 (std::invalid_argument).
double binomial_two_sided_p(std::int64_t successes, std::int64_t trials, double p0 = 0.5);

/// A confidence interval of a proportion, within [0, 1].
struct Interval {
    double low = 0, high = 1;
};

/// Wilson's score interval [Wilson1927], without continuity correction.
/// Needs 0 <= successes <= trials, trials > 0 and 0 < confidence < 1 (std::invalid_argument).
Interval wilson_interval(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

/// Clopper and Pearson's exact interval [ClopperPearson1934]; needs as wilson_interval.
Interval clopper_pearson_interval(std::int64_t successes, std::int64_t trials, double confidence = 0.95);

/// Cohen's g, the proportion's distance from one half: .05 is small, .15 medium, .25 large [Cohen1988,
/// section 5.2]. Needs 0 <= successes <= trials and trials > 0 (std::invalid_argument).
double cohens_g(std::int64_t successes, std::int64_t trials);

} // namespace stats
