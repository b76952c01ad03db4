// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "forest.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "labels.h"
#include "plot.h"

namespace stats {
namespace {

/// A line of the plot; a heading has no figures.
struct Line {
    std::string label;
    const Figures* figures = nullptr;
    std::size_t series = 0; ///< lines of one shader look alike
};

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

/// Data blocks: x, low, high, y of the pooled proportions of one series, and of all mixed models.
std::string data_blocks(const std::vector<Line>& lines, std::size_t series_count) {
    constexpr double apart = 0.17; // of a line's height
    constexpr double z = 1.959963984540054;
    std::string text, mixed = "$mixed << END\n";
    for (std::size_t series = 0; series < series_count; ++series) {
        text += fmt::format("$series{} << END\n", series);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (lines[i].figures == nullptr || lines[i].series != series) {
                continue;
            }
            const Figures& f = *lines[i].figures;
            const auto y = static_cast<double>(i);
            text += fmt::format("{} {} {} {}\n", f.proportion, f.ci.low, f.ci.high, y - apart);
            if (const auto& model = f.participant.mixed) {
                const double half = z * model->standard_error;
                mixed += fmt::format("{} {} {} {}\n", logistic(model->intercept),
                                     logistic(model->intercept - half), logistic(model->intercept + half),
                                     y + apart);
            }
        }
        text += "END\n";
    }
    // A point outside the range keeps an empty block from being an error.
    return text + mixed + "-9 -9 -9 0\nEND\n";
}

std::string forest(const std::vector<Line>& lines, const Analysis& analysis, const std::string& notice,
                   std::string_view title) {
    constexpr double width = 1080, row = 24, top = 64, bottom = 96, margin = 20;
    const double height = top + row * static_cast<double>(lines.size()) + bottom;
    std::string tics;
    std::size_t series_count = 0, longest = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        tics += fmt::format("{}'{}' {}", i == 0 ? "" : ", ", lines[i].label, i);
        series_count = std::max(series_count, lines[i].series + 1);
        longest = std::max(longest, lines[i].label.size());
    }
    const double left = std::min(0.5, (30 + 9 * static_cast<double>(longest)) / width);
    const auto references = references_of(analysis.rows);
    std::string script = figure_head(width, height) + data_blocks(lines, series_count);
    script += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen 0.97\nset tmargin at screen {}\nset bmargin at "
        "screen {}\n"
        "set border 1 linecolor '#333333' linewidth 1\nset tics nomirror out scale 0.6\nset ytics scale 0 "
        "({})\n"
        "set yrange [{}:-0.7]\nset xrange [0:1]\nset xtics 0, 0.25, 1\nset grid xtics linecolor '#e2e2e2' "
        "linewidth 1 linetype 1\nset bars 0.5\nset pointintervalbox 0.01\nset xlabel 'Proportion choosing "
        "{}'\n",
        left, 1 - top / height, bottom / height, tics, static_cast<double>(lines.size()) - 0.3,
        references.size() == 1 ? shader_label(references.front()) : "the reference");
    script += fmt::format("set object 1 rectangle from {}, graph 0 to {}, graph 1 behind fillcolor '#eef3f7' "
                          "fillstyle solid 1 noborder\n",
                          analysis.settings.bounds.low, analysis.settings.bounds.high);
    if (!notice.empty()) {
        script += notice_label(notice, 0.5, 1 - margin / height);
    }
    // The keys stand under the title: filled and open.
    script +=
        fmt::format("set key at screen 0.97, screen {} right top horizontal Left reverse samplen 1.5\n"
                    "set arrow 1 from 0.5, graph 0 to 0.5, graph 1 nohead linecolor '#555555' linewidth 1.5 "
                    "dashtype (8, 5)\nplot ",
                    1 - (margin + 12) / height);
    for (std::size_t series = 0; series < series_count; ++series) {
        script += fmt::format("$series{} using 1:4:2:3 with xerrorbars linewidth 2 {} notitle, ", series,
                              marker_style(series));
    }
    script +=
        "$mixed using 1:4:2:3 with xerrorbars linecolor '#444444' linewidth 1 pointtype 6 pointsize 0.7 "
        "notitle, NaN with points linecolor '#333333' pointtype 5 pointsize 0.7 title 'pooled, Wilson 95 %', "
        "NaN with points linecolor '#444444' pointtype 6 pointsize 0.7 title 'mixed model, Wald 95 %'\n";
    return drawn(script, title);
}

std::string pair_label(const std::string& test, const std::string& reference) {
    return fmt::format("{} against {}", shader_label(test), shader_label(reference));
}

} // namespace

std::string forest_of_shaders(const Analysis& analysis, const std::string& notice) {
    std::vector<Line> lines;
    std::size_t series = 0;
    for (const GroupRow& group : analysis.groups) {
        const bool starts = group.by == "all";
        series += starts && !lines.empty() ? 1 : 0;
        const std::string label = starts                   ? pair_label(group.test, group.reference)
                                  : group.by == "distance" ? distance_label(group.level)
                                                           : group.level + "\u00b0";
        lines.push_back({label, group.figures ? &*group.figures : nullptr, series});
    }
    return forest(lines, analysis, notice, "Forest plot of the shaders");
}

std::string forest_of_conditions(const Analysis& analysis, const std::string& notice) {
    std::vector<Line> lines;
    std::size_t series = 0;
    for (const std::string& reference : references_of(analysis.rows)) {
        for (const std::string& test : tests_of(analysis.rows)) {
            bool any = false;
            for (const Row& row : analysis.rows) {
                if (row.condition.reference != reference || row.condition.test != test) {
                    continue;
                }
                if (!any) {
                    series += lines.empty() ? 0 : 1;
                    lines.push_back({pair_label(test, reference), nullptr, series});
                    any = true;
                }
                lines.push_back({fmt::format("{} - {}", distance_label(row.condition.distance),
                                             azimuth_label(row.condition.azimuth_deg)),
                                 row.figures ? &*row.figures : nullptr, series});
            }
        }
    }
    return forest(lines, analysis, notice, "Forest plot of the conditions");
}

} // namespace stats
