// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stats {

/// What a study is planned to be.
struct PowerPlan {
    std::int64_t participants = 16;
    std::int64_t trials = 24; ///< of each participant, on the question that is tested
    double proportion = 0.65; ///< that is to be found
    std::vector<double> spreads{0, 0.5,
                                1.0}; ///< between participants, standard deviations on the logit scale
    double power = 0.8, level = 0.05;
    std::int64_t studies = 2000; ///< simulated, each
    std::uint64_t seed = 1;
};

/// Power by exact computation and by simulation: text for the terminal, a table of what was simulated for the
/// curve, and the curve.
struct PowerReport {
    std::string text, tsv, svg;
};
PowerReport power_report(const PowerPlan& plan);

} // namespace stats
