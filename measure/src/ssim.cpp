// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/ssim.h>

#include <cmath>

#include "convolution.h"

namespace measure {
namespace {

constexpr int radius = 5;
constexpr double sigma_px = 1.5;
constexpr float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;

Taps window() {
    Taps taps;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) {
        taps.push_back(static_cast<float>(std::exp(-i * i / (2 * sigma_px * sigma_px))));
        sum += static_cast<double>(taps.back());
    }
    for (float& tap : taps) {
        tap /= static_cast<float>(sum);
    }
    return taps;
}

} // namespace

std::vector<float> ssim_map(std::span<const float> image, std::span<const float> reference, int width,
                            int height) {
    const Size size{width, height};
    const Taps taps = window();
    const auto local_mean = [&](auto value) {
        Plane plane(size.pixels());
        for (std::size_t i = 0; i < plane.size(); ++i) {
            plane[i] = value(i);
        }
        return filtered_along_columns(filtered_along_rows(plane, size, taps), size, taps);
    };
    // Middle grey is taken away before squares are, so that floats keep small variances.
    constexpr float middle = 0.5f;
    const auto a = [&](std::size_t i) { return image[i] - middle; };
    const auto b = [&](std::size_t i) { return reference[i] - middle; };
    const Plane mean_a = local_mean(a);
    const Plane mean_b = local_mean(b);
    const Plane mean_aa = local_mean([&](std::size_t i) { return a(i) * a(i); });
    const Plane mean_bb = local_mean([&](std::size_t i) { return b(i) * b(i); });
    const Plane mean_ab = local_mean([&](std::size_t i) { return a(i) * b(i); });

    // [Wang2004, Eq. 13]
    std::vector<float> result(size.pixels());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const float variance_a = mean_aa[i] - mean_a[i] * mean_a[i];
        const float variance_b = mean_bb[i] - mean_b[i] * mean_b[i];
        const float covariance = mean_ab[i] - mean_a[i] * mean_b[i];
        const float ma = mean_a[i] + middle;
        const float mb = mean_b[i] + middle;
        result[i] = (2 * ma * mb + c1) * (2 * covariance + c2) /
                    ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2));
    }
    return result;
}

} // namespace measure
