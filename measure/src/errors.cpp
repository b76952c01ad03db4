// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <glm/glm.hpp>

#include <measure/color.h>
#include <measure/flip.h>
#include <measure/ssim.h>
#include <renderer/optics/color.h>

#include "convolution.h"

namespace measure {
namespace {

/// Luma of the display signal, 0 to 1 [ITU2015].
std::vector<float> luma(const Picture& picture) {
    std::vector<float> result(picture.pixels());
    for_each_in_parallel(result.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto signal = [&](std::size_t c) {
                return renderer::optics::srgb_from_linear(
                    std::clamp(static_cast<double>(picture.linear[3 * i + c]), 0.0, 1.0));
            };
            result[i] = static_cast<float>(0.2126 * signal(0) + 0.7152 * signal(1) + 0.0722 * signal(2));
        }
    });
    return result;
}

void measure_light(const Picture& image, const Picture& reference, const std::vector<unsigned char>& object,
                   Errors& errors) {
    double sum_all = 0, sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        double squares = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double error = static_cast<double>(image.linear[3 * i + c]) -
                                 static_cast<double>(reference.linear[3 * i + c]);
            squares += error * error;
        }
        sum_all += squares;
        sum += object[i] ? squares : 0;
    }
    const double mean_square = sum / (3 * static_cast<double>(errors.object_pixels));
    errors.rmse = std::sqrt(mean_square);
    errors.rmse_all = std::sqrt(sum_all / (3 * static_cast<double>(image.pixels())));
    errors.psnr_db =
        mean_square > 0 ? -10 * std::log10(mean_square) : std::numeric_limits<double>::infinity();
}

void measure_color(const Picture& image, const Picture& reference, const std::vector<unsigned char>& object,
                   Errors& errors) {
    std::vector<double> differences(image.pixels());
    for_each_in_parallel(image.pixels(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto lab = [&](const Picture& picture) {
                const glm::dvec3 linear(picture.linear[3 * i], picture.linear[3 * i + 1],
                                        picture.linear[3 * i + 2]);
                return lab_from_linear(glm::clamp(linear, 0.0, 1.0));
            };
            if (object[i]) {
                differences[i] = ciede2000(lab(image), lab(reference));
            }
        }
    });
    std::vector<double> of_object;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        if (object[i]) {
            of_object.push_back(differences[i]);
        }
    }
    const auto count = static_cast<double>(of_object.size());
    errors.de2000_mean = std::accumulate(of_object.begin(), of_object.end(), 0.0) / count;
    const auto rank = of_object.begin() + static_cast<std::ptrdiff_t>(std::ceil(0.95 * count)) - 1;
    std::nth_element(of_object.begin(), rank, of_object.end());
    errors.de2000_p95 = *rank;
}

} // namespace

double pixels_per_degree(double screen_width_mm, double screen_width_px, double distance_mm) {
    return distance_mm * screen_width_px / screen_width_mm * std::numbers::pi / 180;
}

double default_pixels_per_degree() { return pixels_per_degree(700, 3840, 700); }

Comparison compare(const Picture& image, const Picture& reference, double pixels_per_degree) {
    const std::vector<unsigned char> object = object_pixels(image, reference);
    Comparison result;
    Errors& errors = result.errors;
    errors.object_pixels = static_cast<std::size_t>(std::count(object.begin(), object.end(), 1));
    measure_light(image, reference, object, errors);
    measure_color(image, reference, object, errors);

    const std::vector<float> ssim = ssim_map(luma(image), luma(reference), image.width, image.height);
    double sum = 0;
    for (std::size_t i = 0; i < ssim.size(); ++i) {
        sum += object[i] ? static_cast<double>(ssim[i]) : 0;
    }
    errors.ssim = sum / static_cast<double>(errors.object_pixels);

    result.flip = flip_map(image.linear, reference.linear, image.width, image.height, pixels_per_degree);
    errors.flip = std::accumulate(result.flip.begin(), result.flip.end(), 0.0) /
                  static_cast<double>(result.flip.size());
    return result;
}

} // namespace measure
