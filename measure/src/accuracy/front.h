// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <string>
#include <vector>

#include "sweep.h"

namespace measure {

/// One setting at one distance, over all azimuths.
struct Summary {
    std::string shader, setting, distance;
    double time_ms = 0, time_spread_ms = 0, scatter_ms = 0; ///< means of the views' medians and spreads
    double flip = 0, rmse = 0, de2000_mean = 0, ssim = 0;   ///< means
    bool on_front = false; ///< no setting at this distance is both faster and nearer to the reference by FLIP
};

/// In the rows' order.
std::vector<Summary> summaries(std::span<const AccuracyRow> rows);

/// The distances, each once; and the settings on the front of one, the fastest first.
std::vector<std::string> distances_of(std::span<const Summary> summaries);
std::vector<Summary> front_of(std::span<const Summary> summaries, const std::string& distance);

/// What the figures say, in sentences.
std::vector<std::string> accuracy_findings(const AccuracyResult& result, std::span<const Summary> summaries);

} // namespace measure
