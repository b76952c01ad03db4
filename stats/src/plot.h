// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

namespace stats {

/// gnuplot's commands that open an SVG figure of this size, in pixels.
std::string figure_head(double width, double height);

/// gnuplot's words for the look of a series of points: a colour that colour-blind readers tell apart
/// [Okabe2008], and a marker.
std::string marker_style(std::size_t series);

/// gnuplot's words for the line of no preference.
inline constexpr std::string_view no_preference_style =
    "with lines linecolor '#555555' linewidth 1.5 dashtype (8, 5)";

/// The commands that write a notice across the figure's top, at this share of its width and height.
std::string notice_label(const std::string& notice, double x, double y);

/// Draw the script; the figure is named by the title. Throws support::Failure as support::gnuplot_svg() does.
std::string drawn(const std::string& script, std::string_view title);

/// Replace every occurrence.
void replace_all(std::string& text, std::string_view from, std::string_view to);

} // namespace stats
