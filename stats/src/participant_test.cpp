// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/participant_test.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

#include <stats/proportion.h>
#include <support/random.h>

namespace stats {
namespace {

/// The participants' surpluses without their signs, in their largest common unit, and the observed sum.
struct Surpluses {
    std::map<std::int64_t, std::int64_t> count_by_size; ///< none of size 0: its sign changes nothing
    std::int64_t participants = 0, total = 0;
    std::int64_t observed = 0; ///< absolute value of the signed sum
};

Surpluses surpluses_of(std::span<const Tally> participants) {
    std::int64_t unit = 0, sum = 0;
    for (const auto& [n, k] : participants) {
        unit = std::gcd(unit, 2 * k - n);
        sum += 2 * k - n;
    }
    Surpluses result;
    for (const auto& [n, k] : participants) {
        if (2 * k != n) {
            const std::int64_t size = std::abs(2 * k - n) / unit;
            ++result.count_by_size[size];
            ++result.participants;
            result.total += size;
        }
    }
    result.observed = unit == 0 ? 0 : std::abs(sum) / unit;
    return result;
}

/// The probability of a sum as far from 0 or farther, from the distribution of all sign patterns.
double exact_p(const Surpluses& surpluses) {
    // Probabilities of the sums -reach ... reach; one participant after the other shifts them either way.
    std::vector<double> probability{1};
    for (const auto& [size, count] : surpluses.count_by_size) {
        const auto shift = static_cast<std::size_t>(size);
        for (std::int64_t i = 0; i < count; ++i) {
            std::vector<double> next(probability.size() + 2 * shift, 0.0);
            for (std::size_t j = 0; j < probability.size(); ++j) {
                next[j] += 0.5 * probability[j];
                next[j + 2 * shift] += 0.5 * probability[j];
            }
            probability = std::move(next);
        }
    }
    // Both tails are alike; add the small ones first.
    double tail = 0;
    for (std::int64_t sum = surpluses.total; sum >= surpluses.observed; --sum) {
        tail += probability[static_cast<std::size_t>(surpluses.total - sum)];
    }
    return std::min(1.0, 2 * tail);
}

/// How many of `count` fair coins show heads.
std::int64_t heads(std::int64_t count, support::Generator& generator) {
    std::int64_t result = 0;
    for (; count >= 64; count -= 64) {
        result += std::popcount(generator.next());
    }
    return count == 0 ? result : result + std::popcount(generator.next() >> (64 - count));
}

SignFlip drawn_p(const Surpluses& surpluses, const SignFlipLimits& limits) {
    support::Generator generator("sign flip", limits.seed);
    std::int64_t as_far = 0;
    for (std::int64_t draw = 0; draw < limits.draws; ++draw) {
        std::int64_t sum = 0;
        for (const auto& [size, count] : surpluses.count_by_size) {
            sum += size * (2 * heads(count, generator) - count);
        }
        as_far += std::abs(sum) >= surpluses.observed ? 1 : 0;
    }
    const auto draws = static_cast<double>(limits.draws);
    const double p = (static_cast<double>(as_far) + 1) / (draws + 1);
    return {p, std::sqrt(p * (1 - p) / draws), false};
}

/// Mean of the participants' proportions, its standard error and degrees of freedom.
struct Mean {
    double value = 0, standard_error = 0, df = 0;
};

std::optional<Mean> mean_proportion(std::span<const Tally> participants) {
    std::vector<double> proportions;
    for (const auto& [n, k] : participants) {
        if (n > 0) {
            proportions.push_back(static_cast<double>(k) / static_cast<double>(n));
        }
    }
    const auto [least, most] = std::minmax_element(proportions.begin(), proportions.end());
    if (proportions.size() < 2 || *least == *most) {
        return std::nullopt;
    }
    const auto count = static_cast<double>(proportions.size());
    const double mean = std::accumulate(proportions.begin(), proportions.end(), 0.0) / count;
    double squares = 0;
    for (const double proportion : proportions) {
        squares += (proportion - mean) * (proportion - mean);
    }
    return Mean{mean, std::sqrt(squares / (count - 1) / count), count - 1};
}

/// The probability of a t as large or larger.
double upper_tail(double t, double df) {
    return boost::math::cdf(boost::math::complement(boost::math::students_t(df), t));
}

} // namespace

SignFlip sign_flip(std::span<const Tally> participants, const SignFlipLimits& limits) {
    const Surpluses surpluses = surpluses_of(participants);
    if (surpluses.observed == 0) {
        return {};
    }
    // Where all surpluses are as large, the sum counts heads: a binomial test.
    if (surpluses.count_by_size.size() == 1) {
        const auto [size, count] = *surpluses.count_by_size.begin();
        return {binomial_two_sided_p((surpluses.observed / size + count) / 2, count), 0, true};
    }
    const double additions =
        2 * static_cast<double>(surpluses.participants) * static_cast<double>(surpluses.total);
    return additions <= limits.most_additions ? SignFlip{exact_p(surpluses), 0, true}
                                              : drawn_p(surpluses, limits);
}

double least_sign_flip_p(std::size_t participants) {
    return std::min(1.0, std::ldexp(2.0, -static_cast<int>(std::min<std::size_t>(participants, 2000))));
}

std::optional<TTest> t_test(std::span<const Tally> participants) {
    const auto mean = mean_proportion(participants);
    if (!mean) {
        return std::nullopt;
    }
    const double t = (mean->value - 0.5) / mean->standard_error;
    return TTest{t, mean->df, 2 * upper_tail(std::abs(t), mean->df)};
}

std::optional<double> equivalence_t_test(std::span<const Tally> participants,
                                         const EquivalenceBounds& bounds) {
    const auto mean = mean_proportion(participants);
    if (!mean) {
        return std::nullopt;
    }
    return std::max(upper_tail((mean->value - bounds.low) / mean->standard_error, mean->df),
                    upper_tail((bounds.high - mean->value) / mean->standard_error, mean->df));
}

std::optional<MeanInterval> mean_interval(std::span<const Tally> participants, double confidence) {
    const auto mean = mean_proportion(participants);
    if (!mean) {
        return std::nullopt;
    }
    const boost::math::students_t distribution(mean->df);
    const double half = mean->standard_error *
                        boost::math::quantile(boost::math::complement(distribution, (1 - confidence) / 2));
    return MeanInterval{mean->value, {std::max(0.0, mean->value - half), std::min(1.0, mean->value + half)}};
}

} // namespace stats
