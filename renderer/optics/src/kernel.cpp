// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/optics/kernel.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace renderer::optics {

std::vector<Tap> hable_kernel() {
    std::vector<Tap> taps{
        {{0.000000f, 0.000000f}, {0.220441f, 0.437000f, 0.635000f}},
        {{1.633992f, 0.036795f}, {0.076356f, 0.064487f, 0.039097f}},
        {{0.177801f, 1.717592f}, {0.116515f, 0.103222f, 0.064912f}},
        {{-0.194906f, 0.091094f}, {0.064844f, 0.086388f, 0.062272f}},
        {{-0.239737f, -0.220217f}, {0.131798f, 0.151695f, 0.103676f}},
        {{-0.003530f, -0.118219f}, {0.025690f, 0.042728f, 0.033003f}},
        {{1.320107f, -0.181542f}, {0.048593f, 0.064740f, 0.046131f}},
        {{5.970690f, 0.253378f}, {0.048092f, 0.003042f, 0.000400f}},
        {{-1.089250f, 4.958349f}, {0.048845f, 0.005406f, 0.001222f}},
        {{-4.015465f, 4.156699f}, {0.051322f, 0.006034f, 0.001420f}},
        {{-4.063099f, -4.110150f}, {0.061428f, 0.009152f, 0.002511f}},
        {{-0.638605f, -6.297663f}, {0.030936f, 0.002868f, 0.000652f}},
        {{2.542348f, -3.245901f}, {0.073580f, 0.023239f, 0.009703f}},
    };
    glm::vec3 sum{0};
    for (const Tap& tap : taps) {
        sum += tap.weight;
    }
    for (Tap& tap : taps) {
        tap.weight /= sum;
    }
    return taps;
}

namespace {

/// The radius within which a share u of the light of the mean channel leaves: the CDF of a sum of Gaussians,
/// 1 - sum w exp(-r^2 / 2v), inverted by bisection.
double radius_of_share(const Profile& profile, double u) {
    double low = 0;
    double high = 0;
    for (const Gaussian& g : profile.gaussians) {
        high = std::max(high, 8 * std::sqrt(g.variance_mm2));
    }
    for (int i = 0; i < 60; ++i) {
        const double r = 0.5 * (low + high);
        double share = 0;
        for (const Gaussian& g : profile.gaussians) {
            share += (g.weight.r + g.weight.g + g.weight.b) / 3 * -std::expm1(-r * r / (2 * g.variance_mm2));
        }
        (share < u ? low : high) = r;
    }
    return 0.5 * (low + high);
}

} // namespace

std::vector<Tap> sunflower_kernel(const Profile& wanted, int count) {
    // A Gaussian without width stands for light that stays where it enters: give it a width that no tap can
    // tell.
    Profile profile = wanted;
    for (Gaussian& g : profile.gaussians) {
        g.variance_mm2 = std::max(g.variance_mm2, 1e-30);
    }
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Tap> taps;
    glm::vec3 sum{0};
    for (int i = 0; i < count; ++i) {
        // Each tap stands for an equal share of the mean channel's light, at that share's middle.
        const double r = radius_of_share(profile, (i + 0.5) / count);
        const glm::dvec3 R = diffuse_reflectance(profile, r);
        const double angle = golden_angle * i;
        const glm::dvec2 offset = r * glm::dvec2(std::cos(angle), std::sin(angle));
        taps.push_back({glm::vec2(offset), glm::vec3(R / std::max((R.r + R.g + R.b) / 3, 1e-300))});
        sum += taps.back().weight;
    }
    for (Tap& tap : taps) {
        tap.weight /= sum;
    }
    return taps;
}

double tap_ratio(int reach, double sigma) {
    // The variance rises with the ratio: bisect.
    double low = 0;
    double high = 1;
    for (int i = 0; i < 60; ++i) {
        const double ratio = 0.5 * (low + high);
        double sum = 1;
        double variance = 0;
        for (int k = 1; k <= reach; ++k) {
            const double weight = 2 * std::pow(ratio, k * k);
            sum += weight;
            variance += weight * k * k;
        }
        (variance < sigma * sigma * sum ? low : high) = ratio;
    }
    return 0.5 * (low + high);
}

glm::vec3 rms_radius(const std::vector<Tap>& kernel) {
    glm::vec3 sum{0};
    for (const Tap& tap : kernel) {
        sum += tap.weight * glm::dot(tap.offset, tap.offset);
    }
    return glm::sqrt(sum);
}

} // namespace renderer::optics
