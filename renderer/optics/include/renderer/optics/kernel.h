// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

namespace renderer::optics {

/// One tap of a convolution over an image: where, and how much of each colour.
struct Tap {
    glm::vec2 offset{0}; ///< kernel units
    glm::vec3 weight{0};
};

/// The 13 taps of [Hable2009], per channel normalised to add up to 1 (as printed, red adds up to .99844).
/// Tap 0 stands for direct reflection, 1-6 for mid-level scattering, 7-12 for wide red scattering.
std::vector<Tap> hable_kernel();

/// `count` taps for a profile, normalised like Hable's: a sunflower whose radii follow the mean of the
/// channels, each channel's weights following its own share there. Offsets in millimetres.
std::vector<Tap> sunflower_kernel(const Profile& profile, int count);

/// Root mean square distance of the taps from the origin, per channel, kernel units.
glm::vec3 rms_radius(const std::vector<Tap>& kernel);

/// Weights of the seven taps at -3, -2, ... 3 standard deviations of the published 1D Gaussian blur
/// [JimenezGutierrez2010, Listing 7.1]; they add up to 1.
constexpr std::array<float, 7> gaussian_taps{0.006f, 0.061f, 0.242f, 0.382f, 0.242f, 0.061f, 0.006f};

/// One 1D Gaussian by taps on whole pixels, `reach` to each side, weighted by ratio^(k^2): the ratio that
/// gives them the standard deviation `sigma`, in distances between taps. Exact where the Gaussian is narrower
/// than a pixel, too; for wide ones it tends to the Gaussian's own exp(-1 / 2 sigma^2). In [0, 1].
double tap_ratio(int reach, double sigma);

} // namespace renderer::optics
