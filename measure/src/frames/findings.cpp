// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "frames.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace measure {
namespace {

// What screen space is to reach over texture space, by place; the papers' own figures.
struct Wanted {
    FramePlace place;
    double fps_over_ts;
};
constexpr std::array<Wanted, 6> wanted_speedups{{{{"table3", "heads", "1"}, 1.12},
                                                 {{"table3", "heads", "3"}, 1.85},
                                                 {{"table3", "heads", "5"}, 2.78},
                                                 {{"section7_5", "scene", "ten_heads_far"}, 3.6},
                                                 {{"section7_5", "scene", "five_heads_hidden"}, 2.0},
                                                 {{"section7_5", "scene", "five_busts"}, 2.8}}};
constexpr double most_far_share = 0.15, most_over_clear = 1.02, least_share_of_copy = 0.5;

const FrameRow* find(const FramesResult& result, const FramePlace& place, std::string_view shader,
                     int msaa = 0) {
    const auto found = std::find_if(result.rows.begin(), result.rows.end(), [&](const FrameRow& row) {
        return row.place == place && row.shader == shader && (msaa == 0 || row.msaa == msaa);
    });
    return found == result.rows.end() ? nullptr : &*found;
}

const EffectRow* find_effects(const FramesResult& result, std::string_view value) {
    const auto found = std::find_if(result.effects.begin(), result.effects.end(),
                                    [&](const EffectRow& row) { return row.place.value == value; });
    return found == result.effects.end() ? nullptr : &*found;
}

const char* verdict(bool reached) { return reached ? "reached" : "not reached"; }

double scattering_ms(const EffectRow& row) {
    const auto found = row.node_ms.find("ss_full");
    return found == row.node_ms.end() ? 0 : found->second;
}

/// The culled texture space's time over that of screen space.
void add_culled(const FramesResult& result, std::vector<std::string>& findings) {
    for (const std::string_view distance : {"medium", "far"}) {
        const FramePlace place{"table7_2", "distance", distance};
        const FrameRow* screen = find(result, place, "ss_full", 1);
        const auto texture = std::find_if(result.rows.begin(), result.rows.end(), [&](const FrameRow& row) {
            return row.place == place && row.setting == "culled" && row.msaa == 1;
        });
        if (screen != nullptr && texture != result.rows.end()) {
            const double ratio = texture->time_ms / screen->time_ms;
            findings.push_back(
                fmt::format("{}: ss_full is never to be slower than ts in its culled form; found {:.2f} "
                            "times its frames: {}",
                            distance, ratio, verdict(ratio >= 1)));
        }
    }
}

void add_far(const FramesResult& result, std::vector<std::string>& findings) {
    const EffectRow* effects = find_effects(result, "one_head_far");
    if (effects != nullptr) {
        const double share = effects->scattering_share;
        findings.push_back(
            fmt::format("far: all of the scattering is to cost at most {:.0f} % of the frame without "
                        "it; found {:.1f} %: {}",
                        100 * most_far_share, 100 * share, verdict(share <= most_far_share)));
    }
}

void add_growth(const FramesResult& result, std::vector<std::string>& findings) {
    const EffectRow* one = find_effects(result, "one_head_medium");
    const EffectRow* five = find_effects(result, "five_heads_medium");
    if (one != nullptr && five != nullptr) {
        const double time = scattering_ms(*five) / scattering_ms(*one);
        const double pixels =
            static_cast<double>(five->skin_pixels) / static_cast<double>(std::max(one->skin_pixels, 1LL));
        findings.push_back(
            fmt::format("from one to five heads: the scattering is to grow no faster than the skin's "
                        "pixels; found {:.2f} times the time for {:.2f} times the pixels: {}",
                        time, pixels, verdict(time <= pixels)));
    }
}

void add_bandwidth(const FramesResult& result, std::vector<std::string>& findings) {
    const EffectRow* row = find_effects(result, "five_heads_medium");
    if (row != nullptr) {
        const double share = row->blur_share_of_copy;
        findings.push_back(fmt::format(
            "blurs, five heads: {:.0f} % of the bytes a second that a copy reaches; {}", 100 * share,
            result.on_cpu ? "no bound is set for a CPU"
                          : fmt::format("wanted {:.0f} %: {}", 100 * least_share_of_copy,
                                        verdict(share >= least_share_of_copy))));
    }
}

} // namespace

std::vector<std::string> frame_findings(const FramesResult& result) {
    std::vector<std::string> findings;
    for (const Wanted& wanted : wanted_speedups) {
        const FrameRow* row = find(result, wanted.place, "ss_full");
        if (row != nullptr && row->fps_over_ts) {
            findings.push_back(
                fmt::format("{} {} {}: ss_full is to make at least {:.2f} times the frames of ts in its "
                            "faithful form; found {:.2f}: {}",
                            wanted.place.table, wanted.place.axis, wanted.place.value, wanted.fps_over_ts,
                            *row->fps_over_ts, verdict(*row->fps_over_ts >= wanted.fps_over_ts)));
        }
    }
    add_culled(result, findings);
    add_far(result, findings);
    if (result.empty_over_clear > 0) {
        findings.push_back(
            fmt::format("empty view: at most {:.0f} % above clearing the screen; found {:+.1f} % "
                        "({:.3f} ms, {:.3f} ms): {}",
                        100 * (most_over_clear - 1), 100 * (result.empty_over_clear - 1), result.empty_ms,
                        result.clear_ms, verdict(result.empty_over_clear <= most_over_clear)));
    }
    add_growth(result, findings);
    add_bandwidth(result, findings);
    return findings;
}

} // namespace measure
