// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <stats/study.h>

namespace stats {

/// The trials of the runs that count, one row each, tab-separated with n/a for what is missing: what R's
/// read.delim(file, na.strings = "n/a") reads.
std::string trials_tsv(const Study& study);

/// The answers as comparisons, comma-separated, as the pwcmp software for pairwise comparisons reads them
/// [PerezOrtiz2017]: observer, session (the run), scene (distance and azimuth), condition_A, condition_B,
/// is_A_selected. A is the reference.
std::string comparisons_csv(const Study& study);

} // namespace stats
