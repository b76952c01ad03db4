// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

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

} // namespace stats
