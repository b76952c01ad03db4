// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <stats/equivalence.h>
#include <stats/proportion.h>
#include <stats/tally.h>

namespace stats {

/// How far the sign-flip test goes before it draws at random.
struct SignFlipLimits {
    double most_additions = 1e8; ///< of the exact distribution
    std::int64_t draws = 50'000; ///< where that is not enough
    std::uint64_t seed = 1;
};

/// Outcome of the sign-flip test.
struct SignFlip {
    double p = 1;              ///< two-sided
    double standard_error = 0; ///< of p where it was drawn at random; 0: exact
    bool exact = true;
};

/// Sign-flip (randomisation) test of the participants [Fisher1935]: if no one prefers either shader, each
/// participant's surplus of answers for the reference is as likely to have the other sign. p is the share of
/// all 2^participants sign patterns whose sum is as far from 0 as the observed one, or farther: exact where
/// limits allow, else from seeded draws, the observed pattern counted in [Phipson2010].
SignFlip sign_flip(std::span<const Tally> participants, const SignFlipLimits& limits = {});

/// The smallest p that the sign-flip test of so many participants can have: two of their 2^participants sign
/// patterns are the most extreme. Below six participants it is above .05.
double least_sign_flip_p(std::size_t participants);

/// One-sample t-test.
struct TTest {
    double t = 0, df = 0, p = 1;
};

/// t-test of the participants' proportions against one half [Student1908]; those without answers are left
/// out. Nothing for fewer than two participants, or where all proportions are the same.
std::optional<TTest> t_test(std::span<const Tally> participants);

/// Two one-sided t-tests of the participants' mean proportion against the bounds [Schuirmann1987]: the larger
/// p of the two. Nothing where t_test() gives nothing.
std::optional<double> equivalence_t_test(std::span<const Tally> participants,
                                         const EquivalenceBounds& bounds = {});

/// The participants' mean proportion with its confidence interval by Student's t, cut to [0, 1].
struct MeanInterval {
    double mean = 0;
    Interval ci;
};

/// Nothing where t_test() gives nothing: one participant, or no spread to judge by. Needs 0 < confidence < 1.
std::optional<MeanInterval> mean_interval(std::span<const Tally> participants, double confidence = 0.95);

} // namespace stats
