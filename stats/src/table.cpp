// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/table.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include <stats/multiplicity.h>

#include "labels.h"

namespace stats {
namespace {

constexpr std::array<std::string_view, 3> known_distances{"far", "near", "zoom"};
constexpr std::array<std::string_view, 3> known_tests{"no_sss", "ss_jittered", "ss_full"};

/// The known names in their order, then the others by name.
template <std::size_t N>
bool in_order(const std::array<std::string_view, N>& known, const std::string& a, const std::string& b) {
    const auto rank = [&](const std::string& name) { return std::find(known.begin(), known.end(), name); };
    return std::make_tuple(rank(a), std::string_view(a)) < std::make_tuple(rank(b), std::string_view(b));
}

bool distance_order(const std::string& a, const std::string& b) { return in_order(known_distances, a, b); }
bool test_order(const std::string& a, const std::string& b) { return in_order(known_tests, a, b); }

struct PaperOrder {
    bool operator()(const Condition& a, const Condition& b) const { return paper_order(a, b); }
};

/// The different values of one of the rows' properties, in an order.
template <typename T, typename Order>
std::vector<T> values_of(std::span<const Row> rows, T Condition::*property, Order order) {
    std::set<T, Order> values(order);
    for (const Row& row : rows) {
        values.insert(row.condition.*property);
    }
    return {values.begin(), values.end()};
}

} // namespace

bool significant(const Row& row) { return row.figures && row.figures->chi_square.p <= alpha; }
bool significant_after_holm(const Row& row) { return row.figures && row.figures->p_holm <= alpha; }
bool significant_after_bh(const Row& row) { return row.figures && row.figures->q_bh <= alpha; }

bool paper_order(const Condition& a, const Condition& b) {
    if (a.distance != b.distance) {
        return distance_order(a.distance, b.distance);
    }
    if (a.azimuth_deg != b.azimuth_deg) {
        return a.azimuth_deg < b.azimuth_deg;
    }
    return a.reference != b.reference ? a.reference < b.reference : test_order(a.test, b.test);
}

std::vector<std::string> tests_of(std::span<const Row> rows) {
    return values_of(rows, &Condition::test, test_order);
}

std::vector<std::string> references_of(std::span<const Row> rows) {
    return values_of(rows, &Condition::reference, std::less<std::string>());
}

std::vector<std::string> distances_of(std::span<const Row> rows) {
    return values_of(rows, &Condition::distance, distance_order);
}

std::vector<double> azimuths_of(std::span<const Row> rows) {
    return values_of(rows, &Condition::azimuth_deg, std::less<double>());
}

std::vector<std::optional<Figures>> figures_of(std::span<const Tally> tallies) {
    std::vector<std::optional<Figures>> result(tallies.size());
    std::vector<double> p_values;
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        const auto [n, k] = tallies[i];
        if (n == 0) {
            continue;
        }
        Figures figures;
        figures.proportion = static_cast<double>(k) / static_cast<double>(n);
        figures.chi_square = chi_square_equal(std::array{k, n - k});
        figures.p_exact = binomial_two_sided_p(k, n);
        figures.ci = wilson_interval(k, n);
        p_values.push_back(figures.chi_square.p);
        result[i] = figures;
    }

    // Correct over the family: every condition of the table that was tested.
    const auto p_holm = holm(p_values), q_bh = benjamini_hochberg(p_values);
    std::size_t tested = 0;
    for (auto& figures : result) {
        if (figures) {
            figures->p_holm = p_holm[tested];
            figures->q_bh = q_bh[tested];
            ++tested;
        }
    }
    return result;
}

std::vector<Row> make_table(const Study& study) {
    // Count the answers of the runs that count, condition by condition.
    std::map<Condition, Tally, PaperOrder> counted;
    for (const Run& run : study.runs) {
        if (!run.used) {
            continue;
        }
        for (const Trial& trial : run.log.trials) {
            Tally& tally = counted[trial.condition];
            tally.n += trial.reference_chosen ? 1 : 0;
            tally.reference_chosen += trial.reference_chosen.value_or(false) ? 1 : 0;
        }
    }

    std::vector<Tally> tallies;
    for (const auto& [condition, tally] : counted) {
        tallies.push_back(tally);
    }
    const auto figures = figures_of(tallies);
    std::vector<Row> rows;
    for (const auto& [condition, tally] : counted) {
        rows.push_back({condition, tally, figures[rows.size()]});
    }
    return rows;
}

std::string to_tsv(std::span<const Row> rows, bool simulated) {
    std::string text =
        "reference\ttest\tdistance\tazimuth_deg\tn\treference_chosen\tproportion\tchi_square\tdf\t"
        "p_chi_square\tp_exact\tp_holm\tq_bh\tci_low\tci_high\tsimulated\n";
    for (const auto& [condition, tally, figures] : rows) {
        text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}", condition.reference, condition.test, condition.distance,
                            exact(condition.azimuth_deg), tally.n, tally.reference_chosen);
        if (figures) {
            const auto& f = *figures;
            text += fmt::format("\t{}\t{}\t{}", exact(f.proportion), exact(f.chi_square.statistic),
                                f.chi_square.df);
            for (const double value : {f.chi_square.p, f.p_exact, f.p_holm, f.q_bh, f.ci.low, f.ci.high}) {
                text += "\t" + exact(value);
            }
        } else {
            text += "\tn/a\tn/a\t1\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a";
        }
        text += simulated ? "\ttrue\n" : "\tfalse\n";
    }
    return text;
}

} // namespace stats
