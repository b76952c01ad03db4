// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <renderer/passes/pipeline.h>

#include "set_bench.h"

namespace measure {

/// One way to render a set.
struct Way {
    enum class How { here, one_run, run_an_image };
    std::string name, state;
    How how = How::here;
    renderer::passes::Switches switches;
    bool overlap = true;
    double bound = 0; ///< RMS of 8-bit levels by which images may differ from everything on; 0: bit for bit
};

/// Everything on; each switch off by itself; everything off; the program once; the program once an image.
std::vector<Way> ways();

/// The protocol to render, as a file that the program can read.
struct SetInput {
    std::filesystem::path protocol_file;
    std::optional<std::filesystem::path> model_file;
};

/// The request's protocol, else that of 2009, written into `scratch` where it is not a file yet or is to be
/// smaller. Throws support::InputError.
SetInput set_input(const SetBenchRequest& request, const std::filesystem::path& scratch);

/// A folder of stimuli, by its manifest.
struct SetFacts {
    std::string driver, model;
    std::map<std::string, std::string> digests; ///< of the files, by name
    long long passes = 0;
    std::map<std::string, long long> counts;
};
SetFacts facts_of(const std::filesystem::path& folder);

/// Render the whole set into `folder`, which is new.
void render_in_way(const Way& way, const SetInput& input, const std::filesystem::path& program,
                   const std::filesystem::path& folder);

} // namespace measure
