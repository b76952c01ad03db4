// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/two_groups.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace stats {
namespace {

/// Ranks of all values, doubled so that mean ranks of ties are whole; the sum of t^3 - t over ties.
struct Ranks {
    std::vector<std::int64_t> doubled;
    double ties = 0;
};

Ranks ranks_of(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
    Ranks ranks{std::vector<std::int64_t>(values.size()), 0};
    for (std::size_t start = 0; start < order.size();) {
        std::size_t end = start;
        while (end < order.size() && values[order[end]] == values[order[start]]) {
            ++end;
        }
        for (std::size_t i = start; i < end; ++i) {
            ranks.doubled[order[i]] = static_cast<std::int64_t>(start + end + 1);
        }
        const auto t = static_cast<double>(end - start);
        ranks.ties += t * t * t - t;
        start = end;
    }
    return ranks;
}

/// The share of all choices of `size` ranks whose sum is as far from the mean as the observed one, or
/// farther.
double exact_p(const std::vector<std::int64_t>& doubled, std::size_t size, std::int64_t observed) {
    // ways[m][s]: how many choices of m of the ranks seen so far have the sum s.
    const std::int64_t total = std::accumulate(doubled.begin(), doubled.end(), std::int64_t{0});
    std::vector<std::vector<double>> ways(size + 1,
                                          std::vector<double>(static_cast<std::size_t>(total) + 1, 0.0));
    ways[0][0] = 1;
    std::size_t seen = 0;
    for (const std::int64_t rank : doubled) {
        ++seen;
        for (std::size_t m = std::min(size, seen); m > 0; --m) {
            for (auto s = static_cast<std::size_t>(rank); s < ways[m].size(); ++s) {
                ways[m][s] += ways[m - 1][s - static_cast<std::size_t>(rank)];
            }
        }
    }
    // Compare distances from the mean in whole numbers: n s against m total.
    const auto n = static_cast<std::int64_t>(doubled.size()), m = static_cast<std::int64_t>(size);
    const std::int64_t distance = std::abs(n * observed - m * total);
    double far = 0, all = 0;
    for (std::size_t s = 0; s < ways[size].size(); ++s) {
        all += ways[size][s];
        far += std::abs(n * static_cast<std::int64_t>(s) - m * total) >= distance ? ways[size][s] : 0;
    }
    return far / all;
}

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variance_of(std::span<const double> values) {
    const double mean = mean_of(values);
    double squares = 0;
    for (const double value : values) {
        squares += (value - mean) * (value - mean);
    }
    return squares / static_cast<double>(values.size() - 1);
}

} // namespace

std::optional<RankSum> rank_sum_test(std::span<const double> first, std::span<const double> second) {
    if (first.empty() || second.empty()) {
        return std::nullopt;
    }
    std::vector<double> values(first.begin(), first.end());
    values.insert(values.end(), second.begin(), second.end());
    const Ranks ranks = ranks_of(values);
    const auto m = static_cast<double>(first.size()), k = static_cast<double>(second.size()), n = m + k;
    const std::int64_t sum =
        std::accumulate(ranks.doubled.begin(),
                        ranks.doubled.begin() + static_cast<std::ptrdiff_t>(first.size()), std::int64_t{0});
    RankSum result;
    result.w = static_cast<double>(sum) / 2 - m * (m + 1) / 2;

    constexpr double most_additions = 1e8;
    if (n * m * n * (n + 1) <= most_additions) {
        result.p = exact_p(ranks.doubled, first.size(), sum);
        return result;
    }
    result.exact = false;
    const double variance = m * k / 12 * (n + 1 - ranks.ties / (n * (n - 1)));
    if (variance > 0) {
        const double z = std::abs(result.w - m * k / 2) / std::sqrt(variance);
        result.p = 2 * boost::math::cdf(boost::math::complement(boost::math::normal(), z));
    }
    return result;
}

std::optional<WelchTest> welch_test(std::span<const double> first, std::span<const double> second) {
    if (first.size() < 2 || second.size() < 2) {
        return std::nullopt;
    }
    const auto m = static_cast<double>(first.size()), k = static_cast<double>(second.size());
    const double a = variance_of(first) / m, b = variance_of(second) / k;
    if (a + b == 0) {
        return std::nullopt;
    }
    WelchTest result;
    result.t = (mean_of(first) - mean_of(second)) / std::sqrt(a + b);
    result.df = (a + b) * (a + b) / (a * a / (m - 1) + b * b / (k - 1));
    const boost::math::students_t distribution(result.df);
    result.p = 2 * boost::math::cdf(boost::math::complement(distribution, std::abs(result.t)));
    return result;
}

double quantile(std::span<const double> sorted, double share) {
    if (sorted.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

} // namespace stats
