// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

namespace stats {

/// Probability that the exact two-sided binomial test against one half is significant at `level`, for
/// `trials` independent answers of which each chooses the reference with probability `proportion`.
double exact_power(std::int64_t trials, double proportion, double level);

/// The proportion above one half that is found with probability `power`; not a number where no number of
/// successes is significant.
double detectable_proportion(std::int64_t trials, double power, double level);

/// The smallest number of independent answers from which on the power never falls below `power` again (it is
/// a sawtooth). 1/2 < proportion <= 1.
std::int64_t trials_needed(double proportion, double power, double level);

/// A design whose participants differ in their preference.
struct Design {
    std::int64_t participants = 16, trials = 2; ///< trials of each participant
    double proportion = 0.65;                   ///< of the reference, the mean over the population
    double spread = 0;                          ///< standard deviation between participants, logit scale
};

/// Shares of simulated studies with a significant result, with the standard error of the first.
struct SimulatedPower {
    double participant_level = 0; ///< sign-flip test over participants
    double standard_error = 0;
    double pooled = 0; ///< chi-square of all answers as if independent
};

/// Power by simulation: logits of participants are normal about the value that gives the mean proportion.
/// The same seed gives the same numbers.
SimulatedPower simulated_power(const Design& design, double level, std::int64_t studies, std::uint64_t seed);

/// The logit of a median participant for which the mean proportion over the population is `proportion`.
double median_logit(double proportion, double spread);

} // namespace stats
