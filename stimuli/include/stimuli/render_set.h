// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <renderer/passes/pipeline.h>
#include <study/protocol.h>

namespace stimuli {

/// What to render, and where to.
struct SetRequest {
    std::filesystem::path protocol_file, out;
    std::optional<std::filesystem::path> model_file;
    std::vector<std::string> only;
    std::string shard;
    bool force = false;  ///< render what is up to date, too
    bool exr = false;    ///< write linear images beside the PNGs
    bool overlap = true; ///< encode and write images while further ones are rendered
    bool quiet = false;  ///< without progress
    renderer::passes::Switches switches;
};

/// What became of one image of the protocol.
struct Outcome {
    std::string name;
    std::string reason; ///< why it was rendered, or why not
    bool rendered = false;
    double milliseconds = 0;
    std::vector<std::string> passes_run, passes_reused, passes_skipped; ///< as scene::Frame has them
    std::map<std::string, long long> counts;
};

/// What was done, and where the time went.
struct SetReport {
    std::vector<Outcome> outcomes;
    renderer::passes::Costs costs; ///< seconds a kind of work; work on other threads overlaps the rest
    double seconds = 0;
    std::string driver, model;
    std::size_t missing = 0;      ///< images of the protocol that the folder still lacks
    std::size_t most_waiting = 0; ///< frames held for encoding while another was rendered, at most
    std::vector<std::string> warnings;
};

/// Render what is missing or out of date, write manifest and contact sheet.
/// Throws support::InputError before anything is written if protocol, model or selection are wrong.
SetReport render_set(const SetRequest& request);

} // namespace stimuli
