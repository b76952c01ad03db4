// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/table.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "answers.h"
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

std::vector<Row> make_table(const Study& study, const Settings& settings) {
    // Put together the answers of the runs that count, condition by condition.
    AnswersByKey<Condition, PaperOrder> counted;
    for (const Run& run : study.runs) {
        if (run.used) {
            for (const Trial& trial : run.log.trials) {
                counted.add(trial.condition, run, trial);
            }
        }
    }
    const auto conditions = counted.keys();
    const auto answers = counted.answers();
    const auto figures = figures_of(answers, settings);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        rows.push_back({conditions[i], answers[i].tally, figures[i]});
    }
    return rows;
}

std::string to_tsv(std::span<const Row> rows, bool simulated) {
    std::string text =
        "reference\ttest\tdistance\tazimuth_deg" + first_columns() + "\tsimulated" + further_columns() + "\n";
    for (const auto& [condition, tally, figures] : rows) {
        text += fmt::format("{}\t{}\t{}\t{}{}\t{}{}\n", condition.reference, condition.test,
                            condition.distance, exact(condition.azimuth_deg), first_fields(tally, figures),
                            simulated, further_fields(figures));
    }
    return text;
}

} // namespace stats
