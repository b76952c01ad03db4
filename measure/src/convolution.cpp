// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "convolution.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace measure {
namespace {

/// sum[x] += weight * values[x], in a loop that compilers turn into vector instructions.
void add_weighted(float* sum, const float* values, float weight, std::size_t count) {
    for (std::size_t x = 0; x < count; ++x) {
        sum[x] += weight * values[x];
    }
}

} // namespace

void for_each_in_parallel(std::size_t count,
                          const std::function<void(std::size_t begin, std::size_t end)>& work) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count),
                      [&](const auto& range) { work(range.begin(), range.end()); });
}

Plane filtered_along_rows(std::span<const float> plane, Size size, const Taps& taps) {
    const auto width = static_cast<std::size_t>(size.width);
    const std::size_t radius = taps.size() / 2;
    Plane result(plane.size());
    for_each_in_parallel(static_cast<std::size_t>(size.height), [&](std::size_t begin, std::size_t end) {
        std::vector<float> padded(width + 2 * radius);
        for (std::size_t y = begin; y < end; ++y) {
            const float* row = &plane[y * width];
            std::fill_n(padded.begin(), radius, row[0]);
            std::copy_n(row, width, &padded[radius]);
            std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, row[width - 1]);
            for (std::size_t i = 0; i < taps.size(); ++i) {
                add_weighted(&result[y * width], &padded[i], taps[i], width);
            }
        }
    });
    return result;
}

Plane filtered_along_columns(std::span<const float> plane, Size size, const Taps& taps) {
    const auto width = static_cast<std::size_t>(size.width);
    const auto radius = static_cast<std::ptrdiff_t>(taps.size() / 2);
    Plane result(plane.size());
    for_each_in_parallel(static_cast<std::size_t>(size.height), [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            for (std::size_t i = 0; i < taps.size(); ++i) {
                const std::ptrdiff_t source = std::clamp<std::ptrdiff_t>(
                    static_cast<std::ptrdiff_t>(y + i) - radius, 0, size.height - 1);
                add_weighted(&result[y * width], &plane[static_cast<std::size_t>(source) * width], taps[i],
                             width);
            }
        }
    });
    return result;
}

} // namespace measure
