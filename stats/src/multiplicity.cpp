// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/multiplicity.h>

#include <algorithm>
#include <numeric>

namespace stats {
namespace {

/// The indices of the values, smallest value first.
std::vector<std::size_t> ascending(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
    return order;
}

} // namespace

std::vector<double> holm(std::span<const double> p_values) {
    const auto order = ascending(p_values);
    std::vector<double> adjusted(p_values.size());

    // The i-th smallest counts (m - i) times, and never less than a smaller one.
    double most = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        most = std::max(most, static_cast<double>(order.size() - i) * p_values[order[i]]);
        adjusted[order[i]] = std::min(1.0, most);
    }
    return adjusted;
}

std::vector<double> benjamini_hochberg(std::span<const double> p_values) {
    const auto order = ascending(p_values);
    const auto m = static_cast<double>(order.size());
    std::vector<double> adjusted(p_values.size());

    // The i-th smallest counts m / i times, and never more than a larger one.
    double least = 1;
    for (std::size_t i = order.size(); i > 0; --i) {
        least = std::min(least, m / static_cast<double>(i) * p_values[order[i - 1]]);
        adjusted[order[i - 1]] = least;
    }
    return adjusted;
}

} // namespace stats
