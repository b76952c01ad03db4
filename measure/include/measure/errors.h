// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <measure/picture.h>

namespace measure {

/// Pixels per degree of the visual field in the middle of a screen.
double pixels_per_degree(double screen_width_mm, double screen_width_px, double distance_mm);

/// FLIP's own viewing conditions [Andersson2020]: 3840 pixels on 0.7 m, seen from 0.7 m.
double default_pixels_per_degree();

/// How an image differs from its reference. The object's pixels are those of object_pixels().
struct Errors {
    double rmse = 0;        ///< root mean square of the linear light's error over the object
    double psnr_db = 0;     ///< of rmse, the peak being 1, the display's white; infinite without an error
    double de2000_mean = 0; ///< CIEDE2000 over the object, light above the display's white cut off
    double de2000_p95 = 0;  ///< what 95 % of the object's pixels do not exceed
    double ssim = 0;     ///< mean SSIM [Wang2004] of the display signal's luma over the object; 1: the same
    double flip = 0;     ///< mean LDR-FLIP [Andersson2020] over all pixels; 0: the same
    double rmse_all = 0; ///< as rmse, over all pixels
    std::size_t object_pixels = 0;
};

struct Comparison {
    Errors errors;
    std::vector<float> flip; ///< FLIP of each pixel, 0 to 1
};

/// Errors of an image. Throws as object_pixels().
Comparison compare(const Picture& image, const Picture& reference, double pixels_per_degree);

} // namespace measure
