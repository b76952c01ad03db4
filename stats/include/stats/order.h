// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <stats/participant_test.h>
#include <stats/tally.h>

namespace stats {

/// Answers by which interval the reference was shown in.
struct OrderTally {
    Tally reference_first, reference_second;
    auto operator<=>(const OrderTally&) const = default;

    std::int64_t n() const { return reference_first.n + reference_second.n; }
    /// How many chose the first interval, whatever it showed.
    std::int64_t first_chosen() const {
        return reference_first.reference_chosen + reference_second.n - reference_second.reference_chosen;
    }
};

/// How well the reference is told from the test, in standard deviations [MacmillanCreelman2005, chapter 7].
/// Infinite where a proportion is 0 or 1; not a number where that leaves nothing defined.
struct Sensitivity {
    double d_prime = 0;       ///< sqrt(2) z(Pc), Pc the proportion choosing the reference: takes no bias
    double d_prime_order = 0; ///< (z(H) - z(F)) / sqrt(2): freed from a bias to one interval
    double bias = 0;          ///< -(z(H) + z(F)) / 2: above 0, the second interval is favoured
};

/// H is the proportion choosing the first interval where it showed the reference, F where it showed the test.
Sensitivity sensitivity(const OrderTally& tally);

/// One participant's choice of the first interval, freed from a preference: H and F weighed alike. Within
/// each condition that was answered in both orders, the reference's surplus where it came first over where it
/// came second; each weighs as many as its pairs of answers. Of n, so many count as the first interval: n is
/// 0 where no condition was answered in both orders, and nothing can be told.
Tally first_interval(std::span<const OrderTally> conditions);

/// The answers of the conditions that were answered in both orders.
OrderTally in_both_orders(std::span<const OrderTally> conditions);

/// Bias to an interval with the participants as the sample.
struct OrderBias {
    std::size_t participants = 0; ///< who answered a condition in both orders
    double first_share = 0.5;     ///< mean over them of (H + F) / 2; 0.5: no bias
    SignFlip sign_flip;           ///< of their surpluses for the first interval
};

/// Nothing where no participant's first_interval() has an answer: then a bias looks like a preference.
std::optional<OrderBias> order_bias(std::span<const Tally> participants, const SignFlipLimits& limits = {});

/// Exact two-sided test [Fisher1935] that one participant's answers hang on the order: all tables with the
/// same margins that are no more probable, with R's relative tolerance of 1e-7. 1 where an order has no
/// answers.
double order_p(const OrderTally& tally);

} // namespace stats
