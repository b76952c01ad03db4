// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <support/gnuplot.h>

namespace measure {
namespace {

/// A shader's look: a colour that colour-blind readers tell apart [Okabe2008], gnuplot's number of a marker.
struct Style {
    std::string_view shader, colour;
    int marker;
};
constexpr std::array<Style, 4> styles{{{"no_sss", "#000000", 4},      // open square
                                       {"ts", "#d55e00", 9},          // triangle
                                       {"ss_jittered", "#009e73", 7}, // circle
                                       {"ss_full", "#0072b2", 5}}};   // square

constexpr int panel_width = 560, height = 640;

/// A data block: time, FLIP of the summaries that are wanted.
template <typename Wanted>
std::string block(const std::string& name, std::span<const Summary> summaries, const Wanted& wanted) {
    std::string text = fmt::format("${} << END\n", name);
    for (const Summary& one : summaries) {
        if (wanted(one)) {
            text += fmt::format("{} {} {}\n", one.time_ms, one.flip, one.time_spread_ms);
        }
    }
    return text + "END\n";
}

/// The settings on the front, numbered along it, as the page's table has them.
std::string front_labels(const std::vector<Summary>& front) {
    std::string text = "unset label\n";
    for (std::size_t i = 0; i < front.size(); ++i) {
        text += fmt::format("set label '{}' at {}, {} left offset 0.7, 0.7 textcolor '#333333' font ',12'\n",
                            i + 1, front[i].time_ms, front[i].flip);
    }
    return text;
}

std::string panel(std::span<const Summary> summaries, const std::string& distance, std::size_t index,
                  std::size_t panels) {
    const std::vector<Summary> front = front_of(summaries, distance);
    const std::string id = fmt::format("p{}", index);
    std::string text;
    std::string plots =
        fmt::format("${}front using 1:2 with steps linecolor '#999999' linewidth 1.5 notitle", id);
    text += block(id + "front", front, [](const Summary&) { return true; });
    double smallest = 1, largest = 1e-6;
    for (const Summary& one : summaries) {
        if (one.distance == distance) {
            smallest = std::min(smallest, std::max(one.flip, 1e-6));
            largest = std::max(largest, one.flip);
        }
    }
    for (const Style& style : styles) {
        const std::string name = fmt::format("{}{}", id, style.shader);
        text += block(name, summaries, [&](const Summary& one) {
            return one.distance == distance && one.shader == style.shader;
        });
        plots +=
            fmt::format(", \\\n ${} using 1:2:3 with xerrorbars linecolor '{}' pointtype {} pointsize 0.9 "
                        "title '{}'",
                        name, style.colour, style.marker, style.shader);
    }
    const auto left = static_cast<double>(index) / static_cast<double>(panels);
    const auto right = static_cast<double>(index + 1) / static_cast<double>(panels);
    text += front_labels(front);
    text += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset title '{}'\nset yrange [{}:{}]\n{}",
        left + 100.0 / panel_width / static_cast<double>(panels),
        right - 15.0 / panel_width / static_cast<double>(panels), distance, 0.8 * smallest, 1.25 * largest,
        index == 0
            ? "set key top right samplen 1\nset ylabel 'FLIP against the reference (log scale)' offset 1, 0\n"
            : "unset key\nunset ylabel\n");
    return text + "plot " + plots + "\n";
}

} // namespace

std::string accuracy_svg(const AccuracyResult& result, std::span<const Summary> summaries) {
    const std::vector<std::string> distances = distances_of(summaries);
    std::string script = fmt::format(
        "set terminal svg noenhanced dynamic size {},{} font 'DejaVu Sans,14' background '#ffffff'\n"
        "set encoding utf8\nset multiplot\nset tmargin at screen 0.93\nset bmargin at screen 0.12\n"
        "set border 3 linecolor '#333333'\nset tics nomirror out scale 0.6\n"
        "set grid linecolor '#e2e2e2' linewidth 1 linetype 1\nset logscale x 2\nset logscale y 10\n"
        "set ytics (0.0005, 0.0007, 0.001, 0.0015, 0.002, 0.003, 0.004, 0.005, 0.006, 0.008, 0.01, 0.015, "
        "0.02, 0.025, "
        "0.03, 0.04, 0.05, 0.06, 0.08, 0.1, 0.15, 0.2, 0.3, 0.5)\nset format x '%g'\n"
        "set xlabel 'milliseconds a frame, {}x{} (log scale)'\n",
        panel_width * distances.size(), height, result.width, result.height);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        script += panel(summaries, distances[i], i, distances.size());
    }
    return support::gnuplot_svg(script + "unset multiplot\n");
}

} // namespace measure
