// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stats/table.h>

namespace stats {

/// A line of Table II: one configuration with a row, or none, for each test shader.
struct GridLine {
    std::string configuration; ///< "TS - Far - 0°"
    std::vector<const Row*> cells;
};

/// Table II as the paper lays it out: configurations down, test shaders across.
struct Grid {
    std::vector<std::string> tests;
    std::vector<GridLine> lines;
    std::optional<std::int64_t> n; ///< answers a condition, where all conditions have as many
};
Grid paper_grid(std::span<const Row> rows);

/// Table II as aligned text in UTF-8 with its legend; non-significant cells carry a * and, with `bold`, the
/// terminal's bold type.
std::string table2_text(const Grid& grid, bool bold);

} // namespace stats
