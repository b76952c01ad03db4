// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/order.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <boost/math/distributions/hypergeometric.hpp>
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
    result.bias = (0 - hits - false_alarms) / 2;
    return result;
}

Tally first_interval(std::span<const OrderTally> conditions) {
    Tally sum;
    for (const auto& [first, second] : conditions) {
        const std::int64_t pairs = first.n * second.n;
        sum.n += 2 * pairs;
        sum.reference_chosen += pairs + first.reference_chosen * second.n - second.reference_chosen * first.n;
    }
    return sum;
}

OrderTally in_both_orders(std::span<const OrderTally> conditions) {
    OrderTally sum;
    for (const auto& [first, second] : conditions) {
        if (first.n > 0 && second.n > 0) {
            sum.reference_first.n += first.n;
            sum.reference_first.reference_chosen += first.reference_chosen;
            sum.reference_second.n += second.n;
            sum.reference_second.reference_chosen += second.reference_chosen;
        }
    }
    return sum;
}

std::optional<OrderBias> order_bias(std::span<const Tally> participants, const SignFlipLimits& limits) {
    OrderBias bias;
    double sum = 0;
    std::vector<Tally> telling;
    for (const Tally& one : participants) {
        if (one.n > 0) {
            sum += static_cast<double>(one.reference_chosen) / static_cast<double>(one.n);
            telling.push_back(one);
        }
    }
    if (telling.empty()) {
        return std::nullopt;
    }
    bias.participants = telling.size();
    bias.first_share = sum / static_cast<double>(telling.size());
    bias.sign_flip = sign_flip(telling, limits);
    return bias;
}

double order_p(const OrderTally& tally) {
    const Tally &first = tally.reference_first, &second = tally.reference_second;
    if (first.n == 0 || second.n == 0) {
        return 1;
    }
    const auto chosen = first.reference_chosen + second.reference_chosen, n = tally.n();
    const boost::math::hypergeometric_distribution<> distribution(
        static_cast<unsigned>(chosen), static_cast<unsigned>(first.n), static_cast<unsigned>(n));
    const auto probability = [&](std::int64_t k) {
        return boost::math::pdf(distribution, static_cast<unsigned>(k));
    };
    constexpr double tolerance = 1 + 1e-7;
    const double observed = probability(first.reference_chosen) * tolerance;
    double p = 0;
    for (std::int64_t k = std::max<std::int64_t>(0, chosen - second.n); k <= std::min(chosen, first.n); ++k) {
        const double one = probability(k);
        p += one <= observed ? one : 0;
    }
    return std::min(1.0, p);
}

} // namespace stats
