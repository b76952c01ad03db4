// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/equivalence.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <fmt/format.h>

namespace stats {
namespace {

void check_counts(std::int64_t successes, std::int64_t trials) {
    if (successes < 0 || trials < successes) {
        throw std::invalid_argument(
            fmt::format("expected 0 <= successes <= trials, found {} of {}", successes, trials));
    }
}

} // namespace

double equivalence_p(std::int64_t successes, std::int64_t trials, const EquivalenceBounds& bounds) {
    check_counts(successes, trials);
    if (!(bounds.low > 0 && bounds.low < bounds.high && bounds.high < 1)) {
        throw std::invalid_argument(
            fmt::format("expected 0 < low < high < 1, found {} and {}", bounds.low, bounds.high));
    }
    const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
    const boost::math::binomial at_low(n, bounds.low), at_high(n, bounds.high);
    const double at_least = successes == 0 ? 1 : boost::math::cdf(boost::math::complement(at_low, k - 1));
    const double at_most = successes == trials ? 1 : boost::math::cdf(at_high, k);
    return std::max(at_least, at_most);
}

double log_bayes_factor_01(std::int64_t successes, std::int64_t trials) {
    check_counts(successes, trials);
    const auto n = static_cast<double>(trials), k = static_cast<double>(successes);

    // Under the flat prior every count is as probable, 1 / (n + 1); under 1/2 it has the binomial's
    // probability.
    constexpr double smallest_with_all_digits = 1e-290;
    const double probability = boost::math::pdf(boost::math::binomial(n, 0.5), k);
    const double log_probability = probability > smallest_with_all_digits
                                       ? std::log(probability)
                                       : boost::math::lgamma(n + 1) - boost::math::lgamma(k + 1) -
                                             boost::math::lgamma(n - k + 1) - n * std::log(2.0);
    return std::log1p(n) + log_probability;
}

} // namespace stats
