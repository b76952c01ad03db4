// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stats/log.h>
#include <stats/proportion.h>
#include <stats/study.h>
#include <stats/tally.h>

namespace stats {

/// Level of significance: a condition differs when p <= alpha [Jimenez2009, Table II].
inline constexpr double alpha = 0.05;

/// The figures of a condition that has answers.
struct Figures {
    double proportion = 0; ///< of answers that chose the reference
    ChiSquare chi_square;  ///< against half and half
    double p_exact = 1;    ///< two-sided binomial
    double p_holm = 1;     ///< chi-square's p, adjusted over the table's rows
    double q_bh = 1;       ///< likewise, Benjamini and Hochberg
    Interval ci;           ///< Wilson, 95 %
};

/// One condition of Table II.
struct Row {
    Condition condition;
    Tally tally;
    std::optional<Figures> figures; ///< absent where n is 0
};

/// Whether the condition's figures call a difference significant, by the p-value named.
bool significant(const Row& row);
bool significant_after_holm(const Row& row);
bool significant_after_bh(const Row& row);

/// Whether a stands before b in the paper's order: distance (far, near, zoom, others), azimuth, reference,
/// test (no_sss, ss_jittered, ss_full, others); others by name.
bool paper_order(const Condition& a, const Condition& b);

/// The rows' shaders other than the reference, in the paper's order; likewise the distances and azimuths.
std::vector<std::string> tests_of(std::span<const Row> rows);
std::vector<std::string> references_of(std::span<const Row> rows);
std::vector<std::string> distances_of(std::span<const Row> rows);
std::vector<double> azimuths_of(std::span<const Row> rows);

/// The figures of each tally; the corrections run over all that have answers.
std::vector<std::optional<Figures>> figures_of(std::span<const Tally> tallies);

/// Table II of the runs that count: one row a condition, in the paper's order.
std::vector<Row> make_table(const Study& study);

/// The table as tab-separated text; numbers read back exactly, missing ones are n/a.
std::string to_tsv(std::span<const Row> rows, bool simulated);

} // namespace stats
