// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <study/protocol.h>

#include "../procedure.h"
#include "../session_plan.h"
#include "../stage.h"

namespace experiment {

namespace fs = std::filesystem;

/// Seconds of the system's clock.
double system_clock_s();

/// The JSON file beside a log: how the log came about, in which order its trials were planned, and what its
/// columns mean.
class Sidecar {
public:
    /// Begin it, or go on with that of a run that was broken off.
    Sidecar(fs::path path, const study::Protocol& protocol, const SessionPlan& plan,
            const std::string& manifest_digest, const StageFacts& stage);

    /// Write the file, or replace it in one step. Throws support::Failure.
    void write() const;
    /// Note when the participant agreed to take part, by the system's clock.
    void note_consent(double time_s) { content_["Consent"] = time_text(time_s); }
    /// Add events.
    void note(const std::vector<Event>& events);
    /// Add what is known at the end; `ending` says how the session ended.
    void finish(std::size_t answers, const std::string& ending, const Stage& stage, const Timing& timing);

    /// A time of the system's clock, as BIDS writes it, in universal time.
    static std::string time_text(double time_s);
    const nlohmann::ordered_json& content() const { return content_; }
    /// When the session is gone on with, its clock: seconds since its start, by the system's clock, but not
    /// before `last_s`.
    double clock_start_s(double last_s) const;

private:
    void begin_part(const SessionPlan& plan, const StageFacts& stage);

    fs::path path_;
    nlohmann::ordered_json content_;
    double now_s_; // of the system's clock, when this part began
};

/// How the screen differs from that of a run's last part, a line each; none for a new run (null).
std::vector<std::string> screen_changes(const nlohmann::ordered_json& sidecar, const StageFacts& stage);

} // namespace experiment
