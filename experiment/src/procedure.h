// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <string>
#include <vector>

#include <study/protocol.h>

#include "log/session_log.h"
#include "schedule.h"
#include "stage.h"

namespace experiment {

/// A text of the protocol with {trial} and {trials} filled in.
std::string fill_in(const std::string& text, std::size_t trial, std::size_t trials);

/// Something that happened in a session.
struct Event {
    double time_s = 0;     ///< since the session's start
    std::size_t trial = 0; ///< that it happened in or before, from 1; 0 in the instructions and in practice
    std::string what;
};

/// What a session measures of itself; seconds.
struct Timing {
    std::vector<double> grey_error_s; ///< of each trial: how much longer the grey was than asked for
    std::vector<double> save_s;       ///< of each answer: from the key to the disk
};

/// What the trials are run with beside the stage.
struct Setting {
    const study::SessionSettings& session;
    const Schedule& schedule;
    Schedule practice = {};   ///< shown before, and not logged
    double clock_start_s = 0; ///< since the session's start, when the stage takes over
    std::function<void(const std::vector<Event>&)> note = {}; ///< takes what happened, and writes nothing
    std::function<void()> keep = {};                          ///< called where something was noted
    std::function<void()> restore = {};                       ///< called before a failed save is tried again
    std::function<void()> between_trials = {};                ///< called when a trial's answer is saved
    Timing* timing = nullptr;                                 ///< where to add what is measured
};

/// Run the session on the stage from the first trial that the log has no answer to: instructions; practice;
/// for each trial its number, the first picture, the grey, the second picture until 1 or 2 is pressed
/// [Jimenez2009, Sec. 5.3]; breaks. An answer is on the disk before anything else is shown. A trial that was
/// disturbed is shown again. Throws what stage and log throw.
void run_trials(const Setting& setting, Stage& stage, SessionLog& log);

/// The page after a consent that was not given.
void run_declined_page(const study::SessionSettings& session, Stage& stage);

/// The page after the last trial.
void run_end_page(const study::SessionSettings& session, const Schedule& schedule, Stage& stage);

} // namespace experiment
