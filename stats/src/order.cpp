// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/order.h>

#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/distributions/normal.hpp>

namespace stats {
namespace {

/// The standard normal's quantile at k of n; infinite at the ends, not a number without answers.
double z_score(std::int64_t k, std::int64_t n) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (n == 0) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (k == 0 || k == n) {
        return k == 0 ? -infinity : infinity;
    }
    return boost::math::quantile(boost::math::normal(), static_cast<double>(k) / static_cast<double>(n));
}

} // namespace

Sensitivity sensitivity(const OrderTally& tally) {
    const Tally &first = tally.reference_first, &second = tally.reference_second;
    const double hits = z_score(first.reference_chosen, first.n);
    const double false_alarms = z_score(second.n - second.reference_chosen, second.n);
    Sensitivity result;
    result.d_prime =
        std::numbers::sqrt2 * z_score(first.reference_chosen + second.reference_chosen, tally.n());
    result.d_prime_order = (hits - false_alarms) / std::numbers::sqrt2;
    result.bias = -(hits + false_alarms) / 2;
    return result;
}

} // namespace stats
