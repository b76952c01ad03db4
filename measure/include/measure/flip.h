// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

namespace measure {

/// LDR-FLIP [Andersson2020]: how different two images look that are shown in turn at the same place, 0 to 1
/// in each pixel. Both are RGB, linear Rec. 709; what a display cannot show is cut off at 0 and 1. Beyond the
/// border the image's edge goes on.
std::vector<float> flip_map(std::span<const float> image, std::span<const float> reference, int width,
                            int height, double pixels_per_degree);

} // namespace measure
