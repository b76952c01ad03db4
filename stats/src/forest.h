// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <stats/analysis.h>

namespace stats {

/// Forest plots as SVG, drawn by gnuplot: a line a row with the proportion that chose the reference, pooled
/// with its Wilson 95 % interval (filled) and of a median participant by the mixed model with its Wald 95 %
/// interval (open), over the band of the equivalence bounds. Of shaders (all, by distance, by azimuth), or of
/// all conditions. `notice` stands in the figure where it is not empty. Throws support::Failure as
/// support::gnuplot_svg() does.
std::string forest_of_shaders(const Analysis& analysis, const std::string& notice);
std::string forest_of_conditions(const Analysis& analysis, const std::string& notice);

} // namespace stats
