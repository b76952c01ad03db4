// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <study/protocol.h>

#include "session.h"
#include "session_plan.h"
#include "stage.h"
#include "stimulus_set.h"

namespace experiment {

/// The experimenter's page before a session: what will happen, and every warning.
Form start_page(const SessionOptions& options, const study::Protocol& protocol, const StimulusSet& stimuli,
                const SessionPlan& plan, const StageFacts& stage);

/// Print the trials in the order they will be shown, as a table.
void print_order(const Schedule& schedule);

/// Check the display where there is to be one, and print what the start page would say.
void print_dry_run(const SessionOptions& options, const study::Protocol& protocol, const StimulusSet& stimuli,
                   const SessionPlan& plan);

} // namespace experiment
