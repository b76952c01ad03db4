// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "expansion.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace renderer::optics {
namespace {

// The trapezoidal rule of an analytic function that falls off on both sides converges exponentially: at this
// ratio of neighbouring widths its error is below 5e-4 of either profile, where that is not faint (see the
// tests).
constexpr double width_ratio = 1.3;

// A Gaussian with less of the energy than this in every channel is left out.
constexpr double least_energy = 1e-8;

} // namespace

Profile sum_of_gaussians(const std::function<glm::dvec3(double)>& density, const glm::dvec3& total,
                         double narrowest_mm, double widest_mm, std::string_view name) {
    Profile profile{std::string(name), {}};
    const double step = std::log(width_ratio);
    glm::dvec3 sum{0};
    for (double sigma_mm = narrowest_mm; sigma_mm < widest_mm * width_ratio; sigma_mm *= width_ratio) {
        const double t = 1 / (std::sqrt(2.0) * sigma_mm);
        const glm::dvec3 weight = density(t) * t * step / total; // dt = t d(ln t)
        if (std::max({weight.r, weight.g, weight.b}) > least_energy) {
            profile.gaussians.push_back({sigma_mm * sigma_mm, weight});
            sum += weight;
        }
    }
    for (Gaussian& g : profile.gaussians) {
        g.weight /= sum;
    }
    return profile;
}

} // namespace renderer::optics
