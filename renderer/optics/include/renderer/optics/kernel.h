// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace renderer::optics {

/// One tap of a convolution over an image: where, and how much of each colour.
struct Tap {
    glm::vec2 offset{0}; ///< kernel units
    glm::vec3 weight{0};
};

/// The 13 taps of [Hable2009], per channel normalised to add up to 1 (as printed, red adds up to .99844).
/// Tap 0 stands for direct reflection, 1-6 for mid-level scattering, 7-12 for wide red scattering.
std::vector<Tap> hable_kernel();

/// Root mean square distance of the taps from the origin, per channel, kernel units.
glm::vec3 rms_radius(const std::vector<Tap>& kernel);

/// Weights of the seven taps at -3, -2, ... 3 standard deviations of the published 1D Gaussian blur
/// [JimenezGutierrez2010, Listing 7.1]; they add up to 1.
constexpr std::array<float, 7> gaussian_taps{0.006f, 0.061f, 0.242f, 0.382f, 0.242f, 0.061f, 0.006f};

} // namespace renderer::optics
