// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stats/figures.h>
#include <stats/log.h>
#include <stats/study.h>

namespace stats {

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

/// Table II of the runs that count: one row a condition, in the paper's order.
std::vector<Row> make_table(const Study& study, const Settings& settings = {});

/// The table as tab-separated text; numbers read back exactly, missing ones are n/a.
std::string to_tsv(std::span<const Row> rows, bool simulated);

} // namespace stats
