// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "frames.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <support/error.h>

namespace measure {
namespace {

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : "n/a"; }

std::string ratio(const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value) : ""; }

double value_of(const std::map<std::string, double>& values, const char* name) {
    const auto found = values.find(name);
    return found == values.end() ? 0 : found->second;
}

/// What scatters, and what the two other effects cost; the papers' milliseconds for the scenes they name
/// [JimenezGutierrez2010, section 7.5].
struct PublishedEffects {
    std::string_view value;
    double scattering_ms;
};
constexpr double published_bloom_ms = 2.7, published_depth_of_field_ms = 5.8;
constexpr std::array<PublishedEffects, 2> published_effects{
    {{"one_head_near", 14.0}, {"three_heads_medium", 4.6}}};
constexpr std::array<std::pair<const char*, const char*>, 3> effect_names{
    {{"ss_full", "scattering"}, {"bloom", "bloom"}, {"depth of field", "depth_of_field"}}};

std::optional<double> published_ms(const EffectRow& row, std::string_view effect) {
    for (const PublishedEffects& one : published_effects) {
        if (one.value == row.place.value) {
            return effect == "bloom"            ? published_bloom_ms
                   : effect == "depth_of_field" ? published_depth_of_field_ms
                                                : one.scattering_ms;
        }
    }
    return std::nullopt;
}

std::string effects_text(const FramesResult& result) {
    std::string text = "\nEffects alone, ms (MSAA 1, two lights; in brackets those of the paper's own "
                       "scenes: SSS dominating, three "
                       "heads at medium distance)\n";
    text += fmt::format("{:<22}{:>20}{:>20}{:>20}{:>14}{:>10}\n", "scene", "scattering", "bloom",
                        "depth of field", "skin pixels", "of copy");
    for (const EffectRow& row : result.effects) {
        text += fmt::format("{:<22}", row.place.value);
        for (const auto& [name, effect] : effect_names) {
            const auto published = published_ms(row, effect);
            text += fmt::format("{:>20}", fmt::format("{:.2f}{}", value_of(row.node_ms, name),
                                                      published ? fmt::format(" ({})", *published) : ""));
        }
        text += fmt::format("{:>14}{:>9.0f}%\n", row.skin_pixels, 100 * row.blur_share_of_copy);
    }
    text +=
        fmt::format("of copy: the bytes that the whole node ss_full moves (each texel that a pass reads or "
                    "writes, once, at {} bytes a texel of light)\nin its time, against {:.1f} GB/s of "
                    "glCopyImageSubData between two such textures of {}x{}\n",
                    result.texel_bytes, result.copy_gb_per_s, result.width, result.height);
    return text;
}

} // namespace

std::string frames_tsv(const FramesResult& result) {
    std::string text = "table\taxis\tvalue\tshader\tmsaa\ttime_ms\ttime_spread_ms\tfps\tfps_over_ts\t"
                       "published_fps_over_ts\tsetting\tpublished_fps\tskin_pixels\n";
    for (const FrameRow& row : result.rows) {
        text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", row.place.table,
                            row.place.axis, row.place.value, row.shader, row.msaa, row.time_ms,
                            row.time_spread_ms, 1000 / row.time_ms, cell(row.fps_over_ts),
                            cell(row.published_fps_over_ts), row.setting, cell(row.published_fps),
                            row.skin_pixels);
    }
    for (const EffectRow& row : result.effects) {
        for (const auto& [name, effect] : effect_names) {
            const auto published = published_ms(row, effect);
            text +=
                fmt::format("{}\t{}\t{}\tss_full\t1\t{}\t{}\t{}\tn/a\tn/a\t{}\t{}\t{}\n", row.place.table,
                            row.place.axis, row.place.value, value_of(row.node_ms, name),
                            value_of(row.node_spread_ms, name), 1000 / value_of(row.node_ms, name), effect,
                            published ? fmt::format("{}", 1000 / *published) : "n/a", row.skin_pixels);
        }
    }
    return text;
}

std::string frames_text(const FramesResult& result) {
    std::string text = fmt::format(
        "Frames at {}x{}{}, {} rounds, {} on {}, {}, model {}{}\n\n", result.width, result.height,
        result.quick ? " (quick: a quarter of the pixels, fewer scenes)" : "", result.rounds, result.driver,
        result.processor, result.date, support::one_line(result.model),
        result.bust.empty() ? ""
                            : fmt::format(", marble {}{}", support::one_line(result.bust),
                                          result.bust == result.model ? " (no bust was given)" : ""));
    text += fmt::format("{:<44}{:<13}{:<10}{:>5}{:>10}{:>9}{:>8}{:>9}{:>11}\n", "scene", "shader", "setting",
                        "msaa", "ms", "spread", "fps", "over ts", "published");
    std::string scene;
    for (const FrameRow& row : result.rows) {
        const std::string name = fmt::format("{} {} {}", row.place.table, row.place.axis, row.place.value);
        text += fmt::format("{:<44}{:<13}{:<10}{:>5}{:>10.2f}{:>9.2f}{:>8.2f}{:>9}{:>11}\n",
                            name == scene ? "" : name, row.shader, row.setting, row.msaa, row.time_ms,
                            row.time_spread_ms, 1000 / row.time_ms, ratio(row.fps_over_ts),
                            ratio(row.published_fps_over_ts));
        scene = name;
    }
    text += "over ts: the median over the rounds of ts's time over this one's\n";
    if (!result.effects.empty()) {
        text += effects_text(result);
    }
    text += "\n";
    for (const std::string& finding : frame_findings(result)) {
        text += finding + "\n";
    }
    return text;
}

} // namespace measure
