// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "compare.h"

#include <algorithm>

#include <fmt/format.h>

#include <support/error.h>
#include <support/file.h>
#include <support/progress.h>

#include "error_pictures.h"
#include "outputs.h"

namespace measure {
namespace {

namespace fs = std::filesystem;

/// Refuse an output folder whose pictures would be taken for images the next time.
void check_out(const CompareRequest& request) {
    for (const fs::path& input : {request.image, request.reference}) {
        std::error_code none;
        if (request.out && fs::is_directory(input) && fs::equivalent(*request.out, input, none)) {
            throw support::input_error("--out: expected another folder than the images', found {}",
                                       request.out->string());
        }
    }
}

} // namespace

const std::vector<std::string> error_columns{"rmse", "psnr_db", "de2000_mean", "de2000_p95",
                                             "ssim", "flip",    "rmse_all",    "object_pixels"};

std::vector<std::string> error_values(const Errors& errors) {
    std::vector<std::string> values;
    for (const double value : {errors.rmse, errors.psnr_db, errors.de2000_mean, errors.de2000_p95,
                               errors.ssim, errors.flip, errors.rmse_all}) {
        values.push_back(fmt::format("{}", value));
    }
    values.push_back(fmt::format("{}", errors.object_pixels));
    return values;
}

std::vector<ErrorRow> compare(const CompareRequest& request) {
    check_out(request);
    const std::vector<Pair> pairs = find_pairs(request.image, request.reference, request.rules);
    std::optional<Outputs> outputs;
    if (request.out) {
        outputs.emplace(*request.out);
    }
    std::vector<ErrorRow> rows;
    std::optional<support::Progress> progress;
    if (pairs.size() > 1) {
        progress.emplace("comparing", pairs.size());
    }
    for (const Pair& pair : pairs) {
        const Picture image = read_picture(pair.image);
        const Picture reference = read_picture(pair.reference);
        const Comparison comparison = compare(image, reference, request.pixels_per_degree);
        rows.push_back(
            {pair.image.filename().string(), pair.reference.filename().string(), comparison.errors});
        if (outputs) {
            write_error_map(outputs->path(pair.stem + "_flip.png"), comparison.flip, image.width,
                            image.height);
            write_difference(outputs->path(pair.stem + "_difference.png"), image, reference, request.gain);
        }
        if (progress) {
            progress->step(pair.stem);
        }
    }
    if (outputs) {
        outputs->write("errors.tsv", to_tsv(rows));
        outputs->commit();
    }
    return rows;
}

std::string to_tsv(const std::vector<ErrorRow>& rows) {
    std::string text = fmt::format("image\treference\t{}\n", fmt::join(error_columns, "\t"));
    for (const ErrorRow& row : rows) {
        text += fmt::format("{}\t{}\t{}\n", support::one_line(row.image), support::one_line(row.reference),
                            fmt::join(error_values(row.errors), "\t"));
    }
    return text;
}

std::string to_text(const std::vector<ErrorRow>& rows) {
    std::size_t widest = std::string_view("image").size();
    for (const ErrorRow& row : rows) {
        widest = std::max(widest, support::one_line(row.image).size());
    }
    std::string text = fmt::format("{:{}} {:>9} {:>8} {:>8} {:>8} {:>8} {:>9}\n", "image", widest, "RMSE",
                                   "PSNR dB", "dE mean", "dE 95 %", "SSIM", "FLIP");
    for (const ErrorRow& row : rows) {
        const Errors& e = row.errors;
        text += fmt::format("{:{}} {:>9.6f} {:>8.2f} {:>8.3f} {:>8.3f} {:>8.5f} {:>9.6f}\n",
                            support::one_line(row.image), widest, e.rmse, e.psnr_db, e.de2000_mean,
                            e.de2000_p95, e.ssim, e.flip);
    }
    return text;
}

} // namespace measure
