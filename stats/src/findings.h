// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <string>
#include <vector>

#include <stats/study.h>
#include <stats/table.h>

namespace stats {

/// How many rows were tested, and how many of them are significant raw and corrected.
struct Significance {
    std::size_t tests = 0, raw = 0, holm = 0, bh = 0;
};
Significance significance(std::span<const Row> rows);

/// Which conditions differ with the participants as the sample, by Holm's method: a sentence for each pair of
/// shaders, or one that there are too few participants.
std::vector<std::string> participant_findings(std::span<const Row> rows);

/// The answer as the paper tests, by the pooled chi-square, in plain sentences: one for each pair of shaders,
/// then one on the corrections.
std::vector<std::string> findings(std::span<const Row> rows);

/// "SIMULATED DATA: ..." for data that are simulated, else empty.
std::string simulated_notice(const Study& study);

} // namespace stats
