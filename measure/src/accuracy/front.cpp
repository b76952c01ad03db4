// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "front.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

namespace measure {
namespace {

bool beaten(const Summary& one, const Summary& by) {
    return by.distance == one.distance && by.time_ms <= one.time_ms && by.flip <= one.flip &&
           (by.time_ms < one.time_ms || by.flip < one.flip);
}

const Summary* find(std::span<const Summary> all, const std::string& shader, const std::string& setting,
                    const std::string& distance) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Summary& one) {
        return one.shader == shader && one.setting == setting && one.distance == distance;
    });
    return found == all.end() ? nullptr : &*found;
}

/// How soon ss_full comes as near to the reference as ts does.
std::string as_near_as_ts(std::span<const Summary> all, const Summary& ts) {
    const Summary* fastest = nullptr;
    for (const Summary& one : all) {
        if (one.shader == "ss_full" && one.distance == ts.distance && one.flip <= ts.flip &&
            (fastest == nullptr || one.time_ms < fastest->time_ms)) {
            fastest = &one;
        }
    }
    if (fastest == nullptr) {
        return fmt::format("{}: no setting of ss_full reaches the FLIP of ts at its default, {:.4f}.",
                           ts.distance, ts.flip);
    }
    return fmt::format(
        "{}: ss_full ({}) reaches the FLIP of ts at its default ({:.4f}, {:.1f} ms) in {:.1f} ms, "
        "{:.2f} of its time.",
        ts.distance, fastest->setting, ts.flip, ts.time_ms, fastest->time_ms, fastest->time_ms / ts.time_ms);
}

/// In how many views the default of ss_full is so near to the reference.
std::string views_reached(std::span<const AccuracyRow> rows) {
    const auto flip_of = [&](const AccuracyRow& view, const std::string& shader) -> std::optional<double> {
        for (const AccuracyRow& row : rows) {
            if (row.shader == shader && row.setting == "default" && row.distance == view.distance &&
                row.azimuth_deg == view.azimuth_deg) {
                return row.errors.flip;
            }
        }
        return std::nullopt;
    };
    int views = 0, half = 0, as_ts = 0;
    for (const AccuracyRow& row : rows) {
        if (row.shader == "ss_full" && row.setting == "default") {
            ++views;
            half += row.errors.flip <= 0.5 * flip_of(row, "no_sss").value_or(0) ? 1 : 0;
            as_ts += row.errors.flip <= 1.1 * flip_of(row, "ts").value_or(0) ? 1 : 0;
        }
    }
    return fmt::format(
        "FLIP of ss_full at its default is at most half that of no_sss in {} of {} views, and at most 1.1 "
        "times that of ts in {}.",
        half, views, as_ts);
}

} // namespace

std::vector<Summary> summaries(std::span<const AccuracyRow> rows) {
    std::vector<Summary> all;
    std::vector<int> counts;
    for (const AccuracyRow& row : rows) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const Summary& one) {
            return one.shader == row.shader && one.setting == row.setting && one.distance == row.distance;
        });
        const auto at = static_cast<std::size_t>(same - all.begin());
        if (same == all.end()) {
            all.push_back({row.shader, row.setting, row.distance});
            counts.push_back(0);
        }
        // The running mean.
        const double share = 1.0 / ++counts[at];
        const auto add = [&](double& mean, double value) { mean += share * (value - mean); };
        add(all[at].time_ms, row.time_ms);
        add(all[at].time_spread_ms, row.time_spread_ms);
        add(all[at].scatter_ms, row.scatter_ms);
        add(all[at].flip, row.errors.flip);
        add(all[at].rmse, row.errors.rmse);
        add(all[at].de2000_mean, row.errors.de2000_mean);
        add(all[at].ssim, row.errors.ssim);
    }
    for (Summary& one : all) {
        one.on_front =
            std::none_of(all.begin(), all.end(), [&](const Summary& by) { return beaten(one, by); });
    }
    return all;
}

std::vector<std::string> distances_of(std::span<const Summary> summaries) {
    std::vector<std::string> distances;
    for (const Summary& one : summaries) {
        if (std::find(distances.begin(), distances.end(), one.distance) == distances.end()) {
            distances.push_back(one.distance);
        }
    }
    return distances;
}

std::vector<Summary> front_of(std::span<const Summary> summaries, const std::string& distance) {
    std::vector<Summary> front;
    std::copy_if(summaries.begin(), summaries.end(), std::back_inserter(front),
                 [&](const Summary& one) { return one.on_front && one.distance == distance; });
    std::sort(front.begin(), front.end(),
              [](const Summary& a, const Summary& b) { return a.time_ms < b.time_ms; });
    return front;
}

std::vector<std::string> accuracy_findings(const AccuracyResult& result, std::span<const Summary> summaries) {
    std::vector<std::string> sentences{views_reached(result.rows)};
    for (const std::string& distance : distances_of(summaries)) {
        if (const Summary* ts = find(summaries, "ts", "default", distance)) {
            sentences.push_back(as_near_as_ts(summaries, *ts));
        }
    }
    for (const AccuracyRow& row : result.rows) {
        if (row.worse_than_none) {
            sentences.push_back(fmt::format("{} ({}) has a larger RMSE than no_sss: {}, {}°.", row.shader,
                                            row.setting, row.distance, row.azimuth_deg));
        }
    }
    return sentences;
}

} // namespace measure
