// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <stats/analysis.h>

namespace stats {

/// The analysis as JSON: what was used, what was left out and why, every figure of every table.
std::string summary_json(const Analysis& analysis);

} // namespace stats
