// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <stats/analysis.h>

#include "html.h"
#include "pictures.h"

namespace stats {

/// What the report shows beside its numbers.
struct ReportFigures {
    std::string figure8, shaders, conditions;               ///< SVG
    std::vector<std::optional<ConditionPictures>> pictures; ///< one element each row of the analysis
    std::optional<std::string> contact_sheet;               ///< a PNG's bytes
};

/// The report, one self-contained HTML page.
std::string report_html(const Analysis& analysis, const ReportFigures& figures);

} // namespace stats
