// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

namespace stats {

/// The proportions that still count as "no preference"; 0 <= low < high <= 1.
struct EquivalenceBounds {
    double low = 0.35, high = 0.65;
};

/// Two one-sided exact binomial tests [Schuirmann1987]: the larger of the probabilities of as many successes
/// or more if the true proportion were `low`, and of as many or fewer if it were `high`. The proportion lies
/// within the bounds at level alpha when it is <= alpha. 1 without trials.
/// Needs 0 <= successes <= trials and 0 < low < high < 1 (std::invalid_argument).
double equivalence_p(std::int64_t successes, std::int64_t trials, const EquivalenceBounds& bounds = {});

/// Natural logarithm of the Bayes factor for "no preference" (proportion 1/2) against a proportion of which
/// nothing is known before, prior Beta(1, 1) [Kass1995]. Positive favours no preference; 0 without trials.
/// Needs 0 <= successes <= trials (std::invalid_argument).
double log_bayes_factor_01(std::int64_t successes, std::int64_t trials);

} // namespace stats
