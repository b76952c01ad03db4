// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <string>

#include <stats/table.h>

namespace stats {

/// The paper's Figure 8 as SVG, drawn by gnuplot: the proportion choosing the reference for each test shader,
/// by light azimuth and by camera distance, with Wilson 95 % intervals over the pooled answers. `notice`
/// stands in the figure where it is not empty. Throws support::Failure as support::gnuplot_svg() does.
std::string figure8(std::span<const Row> rows, const std::string& notice);

} // namespace stats
