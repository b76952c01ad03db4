// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace experiment {

namespace fs = std::filesystem;

/// The screen as the experimenter describes it.
struct ScreenOptions {
    bool windowed = false;
    int monitor = 1;                       ///< from 1, the primary one
    std::optional<double> distance_cm;     ///< from the eyes
    std::optional<double> screen_width_mm; ///< of the whole screen
};

/// What the command line says of a session.
struct SessionOptions {
    fs::path protocol, stimuli, study;
    std::string participant;
    std::optional<std::uint64_t> seed;
    std::optional<std::string> observer; ///< of a simulated session, see Observer
    ScreenOptions screen;
    bool new_run = false;           ///< even where the last run was broken off
    bool dry_run = false;           ///< check, and show and write nothing
    bool print_order = false;       ///< print the trials, and show and write nothing
    std::optional<fs::path> frames; ///< where every picture's times go
};

/// Check everything, run one session, and print where its log is. Throws support::InputError before anything
/// is written, support::Failure where the session does not reach its end.
void run_session(const SessionOptions& options);

} // namespace experiment
