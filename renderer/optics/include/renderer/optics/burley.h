// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string_view>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

namespace renderer::optics {

/// Burley's profile, A s (exp(-s r / l) + exp(-s r / 3l)) / (8 pi l r), of a surface that light enters
/// diffusely [ChristensenBurley2015].
struct Burley {
    glm::dvec3 albedo{0.5};          ///< A, of the surface, in (0, 1]
    glm::dvec3 mean_free_path_mm{1}; ///< l, above 0
};

/// s of diffuse transmission, 1.9 - A + 3.5 (A - .8)^2 [ChristensenBurley2015].
glm::dvec3 scaling(const Burley& burley);

/// R(r), per mm^2, r above 0: at 0 it is infinite, though its integral is not.
glm::dvec3 diffuse_reflectance(const Burley& burley, double r_mm);

/// Share of the light that leaves within r, 1 - exp(-r / d) / 4 - 3 exp(-r / 3d) / 4, with d = l / s.
glm::dvec3 energy_within(const Burley& burley, double r_mm);

/// The radius within which the share `energy`, in [0, 1), leaves: the inverse of energy_within.
glm::dvec3 radius_of_energy_mm(const Burley& burley, double energy);

/// R / A as a sum of Gaussians (see expanded(Dipole)). The singularity at 0 is cut off at a ten-thousandth of
/// d, within which .003 % of the light leaves.
Profile expanded(const Burley& burley, std::string_view name);

} // namespace renderer::optics
