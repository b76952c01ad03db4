// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <measure/errors.h>

#include "settings.h"

namespace measure {

/// What to benchmark.
struct AccuracyRequest {
    std::optional<std::filesystem::path> model_file, protocol_file, out;
    std::vector<int> azimuths_deg; ///< empty: 60, or the protocol's first
    int rounds = 0;                ///< timed frames of each setting and view; 0: 9, or 3 if quick
    bool quick = false;            ///< a quarter of each map's and image's side, fewer settings
};

/// One setting in one view.
struct AccuracyRow {
    std::string shader, setting, distance;
    int azimuth_deg = 0;
    double time_ms = 0, time_spread_ms = 0;       ///< of a whole frame: median, median absolute deviation
    double scatter_ms = 0, scatter_spread_ms = 0; ///< of the scattering alone, likewise
    Errors errors{};                              ///< against the reference
    bool worse_than_none = false;                 ///< a larger RMSE than no_sss's
};

/// One setting in a scene with a closed form.
struct ClosedFormRow {
    std::string scene, shader, setting, distance;
    double error = 0; ///< root mean square, share of the lit level
};

/// What was measured, on what.
struct AccuracyResult {
    std::vector<AccuracyRow> rows;
    std::vector<ClosedFormRow> closed_forms;
    std::string model, protocol, driver, processor, date;
    int width = 0, height = 0, rounds = 0;
    double pixels_per_degree = 0, reference_s = 0;
    bool quick = false;
};

/// Render the reference of every view, check every setting against it, then time them: in each round every
/// setting and view once, in an order drawn anew from a fixed seed, so that a machine that drifts hurts all
/// alike. Throws support::InputError for model and protocol, support::Failure if a setting's frames are not
/// sound.
AccuracyResult run_accuracy(const AccuracyRequest& request);

/// The middle value, or the mean of the two in the middle; and the median distance from it.
double median(std::vector<double> values);
double median_deviation(const std::vector<double>& values);

} // namespace measure
