// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <string>

#include <stats/study.h>
#include <stats/table.h>

namespace stats {

/// The analysis as JSON: what was used, what was left out and why, each row's figures, how many are
/// significant.
std::string summary_json(const Study& study, std::span<const Row> rows);

} // namespace stats
