// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "figure8.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "labels.h"
#include "plot.h"

namespace stats {
namespace {

constexpr std::string_view no_preference = "no preference", bars = "bars: pooled Wilson 95 %";

/// One pair of shaders.
struct Series {
    std::string reference, test, label;
};

/// The sizes of the figure, in pixels; the legend grows with its entries.
struct Layout {
    static constexpr double width = 1080, title = 78, plot = 325, tics = 50, legend_row = 26, margin = 18;
    double height = 0, frame_bottom = 0, legend_top = 0;

    explicit Layout(const std::vector<Series>& series) {
        // An entry takes its marker, a gap and the longest label, at about 9 pixels a letter.
        std::size_t longest = bars.size();
        for (const Series& one : series) {
            longest = std::max(longest, one.label.size());
        }
        const double columns =
            std::max(1.0, std::floor(0.9 * width / (100 + 9 * static_cast<double>(longest))));
        const double rows = std::ceil(static_cast<double>(series.size() + 2) / columns);
        legend_top = margin + rows * legend_row;
        frame_bottom = legend_top + tics;
        height = frame_bottom + plot + title;
    }
};

/// A group of conditions that stands at one place of the x axis.
struct Category {
    std::string label;
    std::function<bool(const Condition&)> holds;
};

struct Panel {
    std::string title;
    std::vector<Category> categories;
    double left, right; ///< of the plot's frame, as shares of the figure's width
};

std::vector<Series> series_of(std::span<const Row> rows) {
    std::vector<Series> series;
    const auto references = references_of(rows);
    for (const std::string& reference : references) {
        for (const std::string& test : tests_of(rows)) {
            const bool any = std::any_of(rows.begin(), rows.end(), [&](const Row& row) {
                return row.condition.reference == reference && row.condition.test == test;
            });
            if (any) {
                series.push_back({reference, test,
                                  references.size() == 1 ? shader_label(test)
                                                         : fmt::format("{} against {}", shader_label(test),
                                                                       shader_label(reference))});
            }
        }
    }
    return series;
}

/// All answers of a pair in a category.
Tally pooled(std::span<const Row> rows, const Series& series, const Category& category) {
    Tally sum;
    for (const auto& [condition, tally, figures] : rows) {
        if (condition.reference == series.reference && condition.test == series.test &&
            category.holds(condition)) {
            sum.n += tally.n;
            sum.reference_chosen += tally.reference_chosen;
        }
    }
    return sum;
}

/// A data block a series: x, proportion, low, high; the series stand side by side around the category's
/// place.
std::string data_blocks(std::span<const Row> rows, const std::vector<Series>& series, const Panel& panel) {
    constexpr double dodge = 0.16, widest = 0.7;
    const auto count = static_cast<double>(series.size());
    const double step = std::min(dodge, widest / count);
    std::string text;
    for (std::size_t s = 0; s < series.size(); ++s) {
        text += fmt::format("$series{} << END\n", s);
        for (std::size_t c = 0; c < panel.categories.size(); ++c) {
            const Tally tally = pooled(rows, series[s], panel.categories[c]);
            if (tally.n == 0) {
                continue;
            }
            const double x = static_cast<double>(c) + step * (static_cast<double>(s) - (count - 1) / 2);
            const Interval ci = wilson_interval(tally.reference_chosen, tally.n);
            text += fmt::format("{} {} {} {}\n", x,
                                static_cast<double>(tally.reference_chosen) / static_cast<double>(tally.n),
                                ci.low, ci.high);
        }
        text += "END\n";
    }
    return text;
}

/// The commands that draw one panel. Labels need no quoting: logs hold plain names only.
std::string panel_script(std::span<const Row> rows, const std::vector<Series>& series, const Panel& panel) {
    std::string tics;
    for (std::size_t c = 0; c < panel.categories.size(); ++c) {
        tics += fmt::format("{}'{}' {}", c == 0 ? "" : ", ", panel.categories[c].label, c);
    }
    std::string text = data_blocks(rows, series, panel);
    text += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n", panel.left, panel.right);
    text += fmt::format("set title '{}'\nset xtics ({})\nset xrange [-0.5:{}]\n", panel.title, tics,
                        static_cast<double>(panel.categories.size()) - 0.5);
    text += fmt::format("plot 0.5 {}", no_preference_style);
    for (std::size_t s = 0; s < series.size(); ++s) {
        text += fmt::format(", $series{} using 1:2:3:4 with yerrorbars linewidth 2 {}", s, marker_style(s));
    }
    return text + "\n";
}

/// The commands that draw the legend under the panels, as a plot of nothing.
std::string legend_script(const std::vector<Series>& series, const Layout& layout) {
    std::string text =
        fmt::format("set lmargin at screen 0.05\nset rmargin at screen 0.95\n"
                    "set tmargin at screen {}\nset bmargin at screen {}\n"
                    "unset border\nunset tics\nunset grid\nunset title\nunset ylabel\n"
                    "set key inside center center horizontal Left reverse samplen 1.5 width 1.5\n"
                    "plot [0:1] [0:1] ",
                    layout.legend_top / layout.height, Layout::margin / layout.height);
    for (std::size_t s = 0; s < series.size(); ++s) {
        text += fmt::format("NaN with points {} title '{}', ", marker_style(s), series[s].label);
    }
    return text +
           fmt::format("NaN {} title '{}', NaN with points pointtype 0 linecolor '#ffffff' title '{}'\n",
                       no_preference_style, no_preference, bars);
}

/// The commands that open the figure and set what both panels share.
std::string head_script(const Layout& layout, const std::string& reference, const std::string& notice) {
    std::string text =
        figure_head(Layout::width, layout.height) +
        fmt::format("set multiplot\nunset key\n"
                    "set tmargin at screen {}\nset bmargin at screen {}\n"
                    "set border 3 linecolor '#333333' linewidth 1\n"
                    "set tics nomirror out scale 0.6\nset xtics scale 0\n"
                    "set grid ytics linecolor '#e2e2e2' linewidth 1 linetype 1\n"
                    "set yrange [0:1.03]\nset ytics 0, 0.25, 1\nset bars 0.6\nset pointintervalbox 0.01\n"
                    "set ylabel 'Proportion choosing {}' offset 1, 0\n",
                    1 - Layout::title / layout.height, layout.frame_bottom / layout.height, reference);
    if (!notice.empty()) {
        text += notice_label(notice, 0.53, 1 - Layout::margin / layout.height);
    }
    return text;
}

} // namespace

std::string figure8(std::span<const Row> rows, const std::string& notice) {
    Panel azimuths{"By light azimuth", {}, 0.095, 0.57};
    for (const double azimuth_deg : azimuths_of(rows)) {
        azimuths.categories.push_back(
            {azimuth_label(azimuth_deg), [=](const Condition& c) { return c.azimuth_deg == azimuth_deg; }});
    }
    Panel distances{"By camera distance", {}, 0.615, 0.975};
    for (const std::string& distance : distances_of(rows)) {
        distances.categories.push_back(
            {distance_label(distance), [=](const Condition& c) { return c.distance == distance; }});
    }

    const auto references = references_of(rows);
    const auto series = series_of(rows);
    const Layout layout(series);
    std::string script = head_script(
        layout, references.size() == 1 ? shader_label(references.front()) : "the reference", notice);
    script += panel_script(rows, series, azimuths);
    script += "unset label 1\nset format y ''\nunset ylabel\n";
    script += panel_script(rows, series, distances);
    script += legend_script(series, layout);
    script += "unset multiplot\n";

    return drawn(script, "Figure 8: proportion of answers that chose the reference");
}

} // namespace stats
