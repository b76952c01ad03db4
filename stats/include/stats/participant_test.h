// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <stats/equivalence.h>
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

} // namespace stats
