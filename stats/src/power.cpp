// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/power.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>

#include <stats/participant_test.h>
#include <stats/proportion.h>
#include <support/random.h>

namespace stats {
namespace {

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

/// The largest count that is significant on the lower side; -1: none.
std::int64_t lower_critical(std::int64_t trials, double level) {
    const boost::math::binomial half(static_cast<double>(trials), 0.5);
    std::int64_t low = -1, high = trials / 2 + 1;
    while (high - low > 1) {
        const std::int64_t middle = low + (high - low) / 2;
        const bool significant = 2 * middle < trials && // at the mean p is 1
                                 2 * boost::math::cdf(half, static_cast<double>(middle)) <= level;
        (significant ? low : high) = middle;
    }
    return low;
}

} // namespace

double exact_power(std::int64_t trials, double proportion, double level) {
    const std::int64_t critical = trials > 0 ? lower_critical(trials, level) : -1;
    if (critical < 0) {
        return 0;
    }
    const boost::math::binomial truth(static_cast<double>(trials), proportion);
    return boost::math::cdf(truth, static_cast<double>(critical)) +
           boost::math::cdf(boost::math::complement(truth, static_cast<double>(trials - critical - 1)));
}

double detectable_proportion(std::int64_t trials, double power, double level) {
    if (trials < 1 || lower_critical(trials, level) < 0) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    double low = 0.5, high = 1;
    for (double middle = 0.75; low < middle && middle < high; middle = (low + high) / 2) {
        (exact_power(trials, middle, level) < power ? low : high) = middle;
    }
    return high;
}

std::int64_t trials_needed(double proportion, double power, double level) {
    // Double until the power is there at every one of the next few counts, then look down for the last
    // count that lacks it; the teeth of the saw shrink with the count.
    std::int64_t enough = 8;
    constexpr std::int64_t teeth = 8;
    const auto reached = [&](std::int64_t trials) { return exact_power(trials, proportion, level) >= power; };
    for (bool all = false; !all; enough *= 2) {
        all = true;
        for (std::int64_t i = 0; i < teeth && all; ++i) {
            all = reached(enough + i);
        }
    }
    while (enough > 0 && reached(enough - 1)) {
        --enough;
    }
    return enough;
}

double median_logit(double proportion, double spread) {
    // The trapezoidal rule is exact to rounding for so smooth a function on the whole line.
    constexpr double step = 0.1, reach = 12;
    const boost::math::normal standard;
    double low = -40 * (1 + spread), high = 40 * (1 + spread);
    for (double middle = 0; low < middle && middle < high; middle = (low + high) / 2) {
        double mean = 0;
        for (double x = -reach; x <= reach; x += step) {
            mean += step * boost::math::pdf(standard, x) * logistic(middle + spread * x);
        }
        (mean < proportion ? low : high) = middle;
    }
    return (low + high) / 2;
}

SimulatedPower simulated_power(const Design& design, double level, std::int64_t studies, std::uint64_t seed) {
    support::Generator generator("power", seed);
    const double centre = median_logit(design.proportion, design.spread);
    std::int64_t found = 0, found_pooled = 0;
    std::vector<Tally> participants(static_cast<std::size_t>(design.participants));
    for (std::int64_t study = 0; study < studies; ++study) {
        std::int64_t n = 0, k = 0;
        for (Tally& participant : participants) {
            const double p = logistic(centre + design.spread * generator.normal());
            participant = {design.trials, 0};
            for (std::int64_t trial = 0; trial < design.trials; ++trial) {
                participant.reference_chosen += generator.uniform() < p ? 1 : 0;
            }
            n += participant.n;
            k += participant.reference_chosen;
        }
        found += sign_flip(participants).p <= level ? 1 : 0;
        found_pooled += chi_square_equal(std::array{k, n - k}).p <= level ? 1 : 0;
    }
    const auto count = static_cast<double>(studies);
    const double share = static_cast<double>(found) / count;
    return {share, std::sqrt(share * (1 - share) / count), static_cast<double>(found_pooled) / count};
}

} // namespace stats
