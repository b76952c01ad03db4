// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <study/protocol.h>

#include "log/log_content.h"
#include "schedule.h"
#include "session.h"

namespace experiment {

/// What a session is going to do: begin a run, or go on with one that was broken off.
struct SessionPlan {
    int run = 1;
    std::uint64_t seed = 0;
    Schedule schedule;
    std::size_t finished_participants = 0; ///< that the orders are balanced over

    double clock_set_back_s = 0;      ///< by how much at least, since the run was broken off
    std::optional<LogContent> log;    ///< of the run that is gone on with
    nlohmann::ordered_json sidecar;   ///< of that run; null for a new one
    std::vector<std::string> remarks; ///< for the experimenter, one line each

    std::size_t answered() const { return log ? log->trials.size() : 0; }
    bool resumes() const { return !sidecar.is_null(); }
};

/// What a run must be gone on with, beside its protocol.
struct RunIdentity {
    std::string manifest_digest;         ///< of the stimuli
    std::string observer_digest = "n/a"; ///< of a simulated participant
};

/// Look at what the participant's earlier runs have left, and plan. The last run is gone on with, in the
/// order it was planned in, unless it is complete or a new one is asked for; a new one gets the seed's order,
/// balanced over the participants who have finished unless the seed is given. Throws support::InputError for
/// a log or sidecar that is not as the program left it, and for a protocol, stimuli, seed or observer other
/// than the run began with.
SessionPlan make_plan(const SessionOptions& options, const study::Protocol& protocol,
                      const RunIdentity& identity);

} // namespace experiment
