// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "published.h"

namespace measure {

/// What to benchmark.
struct FramesRequest {
    std::optional<std::filesystem::path> model_file, bust_file;
    int rounds = 0; ///< timed frames of each scene and setting; 0: 7, or 3 if quick
    int width = 1280, height = 720, map_size = 1024;
    std::vector<std::string> tables; ///< empty: all
    bool quick = false;              ///< half of each side, fewer scenes
};

/// One setting at one place of the tables.
struct FrameRow {
    FramePlace place;
    std::string shader, setting;
    int msaa = 1;
    double time_ms = 0, time_spread_ms = 0; ///< median, median absolute deviation
    /// Median over the rounds of the faithful ts's time over this one's, both of the same round.
    std::optional<double> fps_over_ts;
    std::optional<double> published_fps_over_ts, published_fps;
    long long skin_pixels = 0;
};

/// What one of several effects costs, with the scattering by the name of its shader, ss_full.
struct EffectRow {
    FramePlace place;
    std::map<std::string, double> node_ms, node_spread_ms; ///< medians, median absolute deviations
    long long skin_pixels = 0;
    std::map<std::string, long long> counts; ///< of the frame
    double scattering_share = 0; ///< of the frame without scattering and lens; median over the rounds
    double blur_bytes = 0, blur_share_of_copy = 0;
};

/// What was measured, on what.
struct FramesResult {
    std::vector<FrameRow> rows;
    std::vector<EffectRow> effects;
    double empty_over_clear = 0, empty_ms = 0, clear_ms = 0; ///< a frame without a head; medians
    double copy_gb_per_s = 0;
    std::string model, bust, driver, processor, date;
    bool on_cpu = false, quick = false;
    int width = 0, height = 0, rounds = 0, texel_bytes = 0, highest_samples = 1;
};

/// Check each setting in each scene, then time them: block by block of scenes, and in each round each scene
/// and setting of the block once, in an order drawn from a fixed seed. Throws support::InputError for models,
/// support::Failure if frames are not sound.
FramesResult run_frames(const FramesRequest& request);

/// frames.tsv; numbers read back exactly.
std::string frames_tsv(const FramesResult& result);
/// The tables beside the papers' figures, for a terminal.
std::string frames_text(const FramesResult& result);

/// One sentence a target that the figures can be held against: what is wanted, what was found, whether
/// reached.
std::vector<std::string> frame_findings(const FramesResult& result);

} // namespace measure
