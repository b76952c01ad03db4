// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "session_log.h"
#include "study_folder.h"

namespace experiment {

/// A run's pictures as BIDS events, three a trial: the first picture, the grey, the second picture; with
/// onset and duration in seconds, and `stim_file` for pictures of which the study has a copy. `log` is the
/// log's text; what is `n/a` there, by hand, is so here. Throws support::Failure for a log that is not the
/// program's.
std::string events_of(const std::string& log, const KeptStimuli& kept);

/// Write them beside the log, `..._events.tsv`; all that is in them is in the log, too. Throws
/// support::Failure, also where a table is there whose columns were changed by hand.
void write_events(const SessionLog& log, const KeptStimuli& kept);

/// What `task-skin2afc_events.json`, at the study's top, says of the columns.
std::string events_description();

} // namespace experiment
