// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

namespace measure {

/// The structural similarity of two signals in [0, 1] around each pixel [Wang2004, Eq. 13]: Gaussian window,
/// 11 x 11, standard deviation 1.5; K1 = 0.01, K2 = 0.03. Beyond the border the image's edge goes on.
std::vector<float> ssim_map(std::span<const float> image, std::span<const float> reference, int width,
                            int height);

} // namespace measure
