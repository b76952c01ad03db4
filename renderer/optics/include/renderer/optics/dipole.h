// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string_view>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

namespace renderer::optics {

/// The dipole approximation of a semi-infinite homogeneous medium [Jensen2001].
struct Dipole {
    glm::dvec3 sigma_s_prime_per_mm{1}; ///< reduced scattering, above 0
    glm::dvec3 sigma_a_per_mm{0};       ///< absorption, above 0
    double eta = 1.3;                   ///< index of refraction
};

/// Coefficients measured by [Jensen2001]: skin1, skin2, marble, ketchup, skimmilk, wholemilk or cream. Throws
/// support::InputError for another name.
Dipole measured_medium(std::string_view name);

/// Depths of the two point sources, millimetres: the real one below the surface, the virtual one above it.
struct SourceDepths {
    glm::dvec3 real_mm{0}, virtual_mm{0};
};
SourceDepths source_depths(const Dipole& dipole);

/// What one source, `depth_mm` from the surface, contributes to the diffuse reflectance at distance r, per
/// mm^2.
glm::dvec3 source_reflectance(const Dipole& dipole, const glm::dvec3& depth_mm, double r_mm);

/// Rd(r), per mm^2: the sum of both sources. The paper prints the virtual one with a stray 1/sigma_t'.
glm::dvec3 diffuse_reflectance(const Dipole& dipole, double r_mm);

/// The integral of Rd over the plane, in closed form, in [0, 1].
glm::dvec3 total_reflectance(const Dipole& dipole);

/// Rd / total_reflectance as a sum of Gaussians. A source's reflectance is an integral of Gaussians of all
/// widths with positive weights; this is its trapezoidal rule in the logarithm of the width, whose error is
/// below 5e-4 of R(r) as long as that is above 1e-4 of R(0).
Profile expanded(const Dipole& dipole, std::string_view name);

} // namespace renderer::optics
