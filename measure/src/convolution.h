// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <span>
#include <vector>

namespace measure {

/// One value a pixel.
using Plane = std::vector<float>;
/// Weights of an odd number of taps around the middle one.
using Taps = std::vector<float>;

struct Size {
    int width = 0, height = 0;
    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Weighted sums along each row, along each column. Beyond the border the outermost value goes on.
Plane filtered_along_rows(std::span<const float> plane, Size size, const Taps& taps);
Plane filtered_along_columns(std::span<const float> plane, Size size, const Taps& taps);

/// Do work for each index in [0, count), on all cores.
void for_each_in_parallel(std::size_t count,
                          const std::function<void(std::size_t begin, std::size_t end)>& work);

} // namespace measure
