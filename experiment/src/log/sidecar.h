// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>
#include <study/protocol.h>

#include "../stage.h"

namespace experiment {

namespace fs = std::filesystem;

/// What is known of a session before its first trial.
struct SessionFacts {
    std::uint64_t seed = 0;
    std::size_t trials_planned = 0;
    std::string stimuli_manifest_digest;
};

/// The JSON file beside a log: how the log came about, and what its columns mean.
class Sidecar {
public:
    Sidecar(fs::path path, const study::Protocol& protocol, const SessionFacts& session,
            const StageFacts& stage);

    /// Write the file, or replace it in one step. Throws support::Failure.
    void write() const;
    /// Add what is known at the end and write; `ending` says how the session ended.
    void finish(std::size_t answers, const std::string& ending, const StageFacts& stage);

    const nlohmann::ordered_json& content() const { return content_; }

private:
    fs::path path_;
    nlohmann::ordered_json content_;
};

} // namespace experiment
