// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "table_text.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "labels.h"

namespace stats {
namespace {

constexpr std::size_t n_width = 6, chi_width = 11, p_width = 9, mark_width = 2, gap = 2;

/// The cells of one condition, every one as wide as its column.
std::string cells_of(const Row* row, bool with_n, bool bold) {
    std::string n, text;
    if (with_n) {
        n = fmt::format("{:>{}}", row ? fmt::format("{}", row->tally.n) : "n/a", n_width);
    }
    if (row == nullptr || !row->figures) {
        return n + fmt::format("{:>{}}{:>{}}{:{}}", "n/a", chi_width, "n/a", p_width, "", mark_width);
    }
    const ChiSquare& chi_square = row->figures->chi_square;
    const bool alike = !significant(*row);
    text = fmt::format("{:>{}}{:>{}}{:{}}", statistic_text(chi_square.statistic), chi_width,
                       p_text(chi_square.p), p_width, alike ? " *" : "", mark_width);
    return n + (alike && bold ? "\x1b[1m" + text + "\x1b[0m" : text);
}

void strip_end(std::string& text) { text.erase(text.find_last_not_of(' ') + 1); }

} // namespace

Grid paper_grid(std::span<const Row> rows) {
    Grid grid;
    grid.tests = tests_of(rows);
    std::set<std::int64_t> counts;
    const Condition* previous = nullptr;
    for (const Row& row : rows) {
        const Condition& c = row.condition;
        counts.insert(row.tally.n);
        if (previous == nullptr || previous->reference != c.reference || previous->distance != c.distance ||
            previous->azimuth_deg != c.azimuth_deg) {
            grid.lines.push_back({configuration_label(c.reference, c.distance, c.azimuth_deg),
                                  std::vector<const Row*>(grid.tests.size(), nullptr)});
        }
        const auto column = std::find(grid.tests.begin(), grid.tests.end(), c.test) - grid.tests.begin();
        grid.lines.back().cells[static_cast<std::size_t>(column)] = &row;
        previous = &c;
    }
    if (counts.size() == 1) {
        grid.n = *counts.begin();
    }
    return grid;
}

std::string table2_text(const Grid& grid, bool bold) {
    const bool with_n = !grid.n;
    std::size_t first_width = std::string_view("Configuration").size();
    for (const GridLine& line : grid.lines) {
        first_width = std::max(first_width, fmt::formatted_size("{}", line.configuration));
    }
    const std::size_t block = (with_n ? n_width : 0) + chi_width + p_width + mark_width;

    // Two header lines: the shaders over their columns.
    std::string text =
        fmt::format("Table II. Chi-square against half and half (df = 1, level of significance {}{})\n\n",
                    alpha, grid.n ? fmt::format(", n = {} a condition", *grid.n) : "");
    std::string shaders = fmt::format("{:{}}", "", first_width),
                columns = fmt::format("{:{}}", "Configuration", first_width);
    for (const std::string& test : grid.tests) {
        shaders += fmt::format("{:{}}{:^{}}", "", gap, shader_label(test), block);
        columns += fmt::format("{:{}}{}{:>{}}{:>{}}{:{}}", "", gap,
                               with_n ? fmt::format("{:>{}}", "n", n_width) : "", "chi-value", chi_width,
                               "p-value", p_width, "", mark_width);
    }
    strip_end(shaders);
    strip_end(columns);
    text += shaders + "\n" + columns + "\n";

    for (const GridLine& line : grid.lines) {
        std::string cells = fmt::format("{:{}}", line.configuration, first_width);
        for (const Row* row : line.cells) {
            cells += std::string(gap, ' ') + cells_of(row, with_n, bold);
        }
        strip_end(cells);
        text += cells + "\n";
    }
    return text + fmt::format("\n* no significant difference (p > {})\n", alpha);
}

} // namespace stats
