// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/proportion.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <fmt/format.h>

namespace stats {
namespace {

void check_counts(std::int64_t successes, std::int64_t trials) {
    if (successes < 0 || trials < successes) {
        throw std::invalid_argument(
            fmt::format("expected 0 <= successes <= trials, found {} of {}", successes, trials));
    }
}

void check_interval(std::int64_t successes, std::int64_t trials, double confidence) {
    check_counts(successes, trials);
    if (trials == 0 || !(confidence > 0 && confidence < 1)) {
        throw std::invalid_argument(
            fmt::format("expected trials > 0 and 0 < confidence < 1, found {} and {}", trials, confidence));
    }
}

/// The number of leading elements of 0 ... count-1 for which the condition holds; it holds for a prefix.
template <typename Condition>
std::int64_t prefix_length(std::int64_t count, Condition holds) {
    std::int64_t low = 0, high = count;
    while (low < high) {
        const std::int64_t middle = low + (high - low) / 2;
        if (holds(middle)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

} // namespace

ChiSquare chi_square_equal(std::span<const std::int64_t> observed) {
    const bool negative = std::any_of(observed.begin(), observed.end(), [](auto count) { return count < 0; });
    const auto total = std::accumulate(observed.begin(), observed.end(), std::int64_t{0});
    if (observed.size() < 2 || negative || total <= 0) {
        throw std::invalid_argument(
            fmt::format("expected two counts or more, none negative and not all 0, found {} with the sum {}",
                        observed.size(), total));
    }

    // Sum the squared deviations from the expected count, in units of the expected count.
    const double expected = static_cast<double>(total) / static_cast<double>(observed.size());
    ChiSquare result;
    for (const std::int64_t count : observed) {
        const double deviation = static_cast<double>(count) - expected;
        result.statistic += deviation * deviation / expected;
    }
    result.df = static_cast<int>(observed.size()) - 1;

    // Take the upper tail directly: 1 - cdf would be 0 where the answer is 1e-17.
    const boost::math::chi_squared distribution(result.df);
    result.p = boost::math::cdf(boost::math::complement(distribution, result.statistic));
    return result;
}

double binomial_two_sided_p(std::int64_t successes, std::int64_t trials, double p0) {
    check_counts(successes, trials);
    if (!(p0 > 0 && p0 < 1)) {
        throw std::invalid_argument(fmt::format("expected 0 < p0 < 1, found {}", p0));
    }
    const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
    const double mean = n * p0;
    if (k == mean) {
        return 1;
    }
    const boost::math::binomial distribution(n, p0);

    // Call an outcome extreme when it is no more probable than the observed one, within R's tolerance.
    const double most = boost::math::pdf(distribution, k) * (1 + 1e-7);
    const auto extreme = [&](std::int64_t outcome) {
        return boost::math::pdf(distribution, static_cast<double>(outcome)) <= most;
    };

    // Count the extreme outcomes of the other side; probabilities fall away from the mean, so bisect.
    if (k < mean) {
        const auto side = trials - static_cast<std::int64_t>(std::ceil(mean)) + 1;
        const auto others = prefix_length(side, [&](auto i) { return extreme(trials - i); });
        const double lower = boost::math::cdf(distribution, k);
        const double upper = others == 0 ? 0
                                         : boost::math::cdf(boost::math::complement(
                                               distribution, static_cast<double>(trials - others)));
        return std::min(1.0, lower + upper);
    }
    const auto side = static_cast<std::int64_t>(std::floor(mean)) + 1;
    const auto others = prefix_length(side, extreme);
    const double lower = others == 0 ? 0 : boost::math::cdf(distribution, static_cast<double>(others - 1));
    const double upper = boost::math::cdf(boost::math::complement(distribution, k - 1));
    return std::min(1.0, lower + upper);
}

Interval wilson_interval(std::int64_t successes, std::int64_t trials, double confidence) {
    check_interval(successes, trials, confidence);
    const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
    const double z =
        boost::math::quantile(boost::math::complement(boost::math::normal(), (1 - confidence) / 2));

    // The bounds are the roots x of (1 + c) x^2 - (2p + c) x + p^2 = 0, with c = z^2 / n [Wilson1927].
    const double c = z * z / n, p = k / n;
    const double root = std::sqrt(c * (c + 4 * p * (n - k) / n));
    const double high = (2 * p + c + root) / (2 * (1 + c));

    // The lower root follows from the product of the roots, which loses no digits near 0.
    const double low = p * p / ((1 + c) * high);
    return {std::clamp(low, 0.0, p), std::clamp(high, p, 1.0)};
}

Interval clopper_pearson_interval(std::int64_t successes, std::int64_t trials, double confidence) {
    check_interval(successes, trials, confidence);
    const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
    const double tail = (1 - confidence) / 2;

    // The bounds are the proportions under which the count is just improbable on one side.
    using boost::math::binomial;
    return {successes == 0 ? 0 : binomial::find_lower_bound_on_p(n, k, tail),
            successes == trials ? 1 : binomial::find_upper_bound_on_p(n, k, tail)};
}

double cohens_g(std::int64_t successes, std::int64_t trials) {
    check_counts(successes, trials);
    if (trials == 0) {
        throw std::invalid_argument("expected trials > 0, found 0");
    }
    return std::abs(static_cast<double>(2 * successes - trials)) / (2 * static_cast<double>(trials));
}

} // namespace stats
