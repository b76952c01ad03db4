// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "plot.h"

#include <array>

#include <fmt/format.h>

#include <support/gnuplot.h>

namespace stats {
namespace {

/// A series' look: a colour that colour-blind readers tell apart [Okabe2008] and gnuplot's number of a
/// marker.
struct Style {
    std::string_view colour;
    int marker;
};
constexpr std::array<Style, 7> styles{{{"#d55e00", 5},   // vermilion square
                                       {"#0072b2", 7},   // blue circle
                                       {"#009e73", 9},   // green triangle
                                       {"#cc79a7", 13},  // purple diamond
                                       {"#e69f00", 11},  // orange triangle, point down
                                       {"#56b4e9", 15},  // sky-blue pentagon
                                       {"#000000", 4}}}; // black open square

constexpr double marker_size = 0.75;

} // namespace

std::string figure_head(double width, double height) {
    return fmt::format(
        "set terminal svg noenhanced dynamic size {},{} font 'DejaVu Sans,15' background '#ffffff'\n"
        "set encoding utf8\n",
        width, height);
}

std::string marker_style(std::size_t series) {
    // After one round of the colours the markers are paired anew.
    return fmt::format("linecolor '{}' pointtype {} pointsize {}", styles[series % styles.size()].colour,
                       styles[(series + series / styles.size()) % styles.size()].marker, marker_size);
}

std::string notice_label(const std::string& notice, double x, double y) {
    return fmt::format("set label 1 '{}' at screen {}, {} center textcolor '#b00020'\n", notice, x, y);
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

std::string drawn(const std::string& script, std::string_view title) {
    std::string svg = support::gnuplot_svg(script);
    // Give the figure its name, and readers without the font another one of the kind.
    replace_all(svg, "<title>Gnuplot</title>", fmt::format("<title>{}</title>", title));
    replace_all(svg, "font-family=\"DejaVu Sans\"",
                "font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\"");
    return svg;
}

} // namespace stats
