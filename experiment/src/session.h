// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace experiment {

namespace fs = std::filesystem;

/// What the command line says of a session.
struct SessionOptions {
    fs::path protocol, stimuli, study;
    std::string participant;
    std::optional<std::uint64_t> seed;
    std::optional<std::string> observer; ///< of a simulated session, see Observer
    bool windowed = false;
};

/// Check everything, run one session, and print where its log is. Throws support::InputError before anything
/// is written, support::Failure where the session does not reach its end.
void run_session(const SessionOptions& options);

} // namespace experiment
