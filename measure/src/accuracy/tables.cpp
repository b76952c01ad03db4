// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report.h"

#include <fmt/format.h>

#include <support/error.h>

#include "compare.h"

namespace measure {

std::string accuracy_tsv(std::span<const AccuracyRow> rows) {
    std::string text =
        fmt::format("shader\tsetting\tdistance\tazimuth_deg\ttime_ms\ttime_spread_ms\t{}\tscatter_ms\t"
                    "scatter_spread_ms\n",
                    fmt::join(error_columns, "\t"));
    for (const AccuracyRow& row : rows) {
        text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", row.shader, row.setting, row.distance,
                            row.azimuth_deg, row.time_ms, row.time_spread_ms,
                            fmt::join(error_values(row.errors), "\t"), row.scatter_ms, row.scatter_spread_ms);
    }
    return text;
}

std::string closed_forms_tsv(std::span<const ClosedFormRow> rows) {
    std::string text = "scene\tshader\tsetting\tdistance\trms_error\n";
    for (const ClosedFormRow& row : rows) {
        text +=
            fmt::format("{}\t{}\t{}\t{}\t{}\n", row.scene, row.shader, row.setting, row.distance, row.error);
    }
    return text;
}

std::string accuracy_text(const AccuracyResult& result, std::span<const Summary> summaries) {
    std::string text =
        fmt::format("On the front of time and FLIP ({}, {}x{}, {} on {})\n\n{:<6} {:<12} {:<30} {:>9} "
                    "{:>8} {:>8} {:>8}\n",
                    support::one_line(result.model), result.width, result.height, result.driver,
                    result.processor, "", "shader", "setting", "ms", "spread", "FLIP", "RMSE");
    for (const std::string& distance : distances_of(summaries)) {
        for (const Summary& one : front_of(summaries, distance)) {
            text += fmt::format("{:<6} {:<12} {:<30} {:>9.2f} {:>8.2f} {:>8.5f} {:>8.5f}\n", one.distance,
                                one.shader, one.setting, one.time_ms, one.time_spread_ms, one.flip, one.rmse);
        }
    }
    text += "\n";
    for (const std::string& sentence : accuracy_findings(result, summaries)) {
        text += sentence + "\n";
    }
    return text;
}

} // namespace measure
