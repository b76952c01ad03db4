// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace measure {

/// What to benchmark.
struct SetBenchRequest {
    std::optional<std::filesystem::path> model_file, protocol_file;
    int rounds = 0;     ///< timed runs of each way; 0: 3, or 1 if quick
    bool quick = false; ///< a quarter of each image's and shadow map's side, two distances, two lights
    std::filesystem::path program = "/proc/self/exe"; ///< skin2afc itself, for separate runs
};

/// One way to render the whole set.
struct SetRow {
    std::string name, state;                ///< the switch, and where it stands
    double seconds = 0, seconds_spread = 0; ///< wall time, model to contact sheet: median, median deviation
    double cpu_seconds = 0;                 ///< of all threads: median
    std::size_t images = 0;
    long long passes = 0, pixels = 0;        ///< passes run; pixels of the images
    std::map<std::string, long long> counts; ///< what the renderer counts, over all images
};

/// What was measured, on what.
struct SetResult {
    std::vector<SetRow> rows; ///< "everything", "on" first
    std::string model, protocol, driver, processor, date;
    int width = 0, height = 0, rounds = 0;
    bool quick = false;
};

// Rows that are no switch of the renderer.
constexpr const char* row_everything = "everything";
constexpr const char* row_overlap = "overlap";
constexpr const char* row_program = "program";
constexpr const char* state_one_run = "one run";
constexpr const char* state_run_an_image = "a run an image";

/// Render the set in every way once and refuse ways whose images differ; then time them: in each round every
/// way once, in an order drawn anew from a fixed seed. Throws support::InputError for model and protocol,
/// support::Failure for images that differ and runs that fail.
SetResult run_set(const SetBenchRequest& request);

/// set.tsv; numbers read back exactly.
std::string set_tsv(const SetResult& result);

/// A table for a terminal: each way against everything on, with what is to be reached beside.
std::string set_text(const SetResult& result);

} // namespace measure
