// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <study/protocol.h>

#include "log/session_log.h"
#include "schedule.h"
#include "stage.h"

namespace experiment {

/// A text of the protocol with {trial} and {trials} filled in.
std::string fill_in(const std::string& text, std::size_t trial, std::size_t trials);

/// Run the whole session on the stage: instructions; for each trial its number, the first picture, the grey,
/// the second picture until 1 or 2 is pressed [Jimenez2009, Sec. 5.3]. An answer is on the disk before
/// anything else is shown. Throws what stage and log throw.
void run_trials(const study::SessionSettings& session, const Schedule& schedule, Stage& stage,
                SessionLog& log);

/// The page after the last trial.
void run_end_page(const study::SessionSettings& session, const Schedule& schedule, Stage& stage);

} // namespace experiment
