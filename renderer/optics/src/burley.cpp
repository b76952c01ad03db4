// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/optics/burley.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "expansion.h"

namespace renderer::optics {
namespace {

/// d = l / s, millimetres: the length of the narrower exponential.
glm::dvec3 narrow_length_mm(const Burley& burley) { return burley.mean_free_path_mm / scaling(burley); }

} // namespace

glm::dvec3 scaling(const Burley& burley) {
    const glm::dvec3 beside = burley.albedo - 0.8;
    return 1.9 - burley.albedo + 3.5 * beside * beside;
}

glm::dvec3 diffuse_reflectance(const Burley& burley, double r_mm) {
    const glm::dvec3 d = narrow_length_mm(burley);
    return burley.albedo * (glm::exp(-r_mm / d) + glm::exp(-r_mm / (3.0 * d))) /
           (8 * std::numbers::pi * r_mm * d);
}

glm::dvec3 energy_within(const Burley& burley, double r_mm) {
    const glm::dvec3 d = narrow_length_mm(burley);
    return 1.0 - 0.25 * glm::exp(-r_mm / d) - 0.75 * glm::exp(-r_mm / (3.0 * d));
}

glm::dvec3 radius_of_energy_mm(const Burley& burley, double energy) {
    // With q = exp(-r / 3d), q^3 + 3q = 4 (1 - energy): a cubic with one real root.
    const double u = 1 - energy;
    const double g = 1 + 4 * u * (2 * u + std::sqrt(1 + 4 * u * u));
    const double q = 4 * u / (1 + std::cbrt(g) + 1 / std::cbrt(g));
    return -3.0 * narrow_length_mm(burley) * std::log(q);
}

Profile expanded(const Burley& burley, std::string_view name) {
    // exp(-a r) / r = 2 / sqrt(pi) * integral over t of exp(-r^2 t^2 - a^2 / 4t^2): Gaussians of variance
    // 1 / 2t^2 with the energy a / (4 sqrt(pi) t^2) exp(-a^2 / 4t^2) for a = 1/d, three times that for 1/3d.
    const glm::dvec3 d = narrow_length_mm(burley);
    const auto density = [&](double t) {
        const glm::dvec3 a = 1.0 / d;
        const glm::dvec3 narrow = glm::exp(-a * a / (4 * t * t));
        const glm::dvec3 wide = glm::exp(-a * a / (36 * t * t));
        return a * (narrow + wide) / (4 * std::sqrt(std::numbers::pi) * t * t);
    };
    const double narrowest_mm = 1e-4 * std::min({d.r, d.g, d.b});
    const double widest_mm = 25 * std::max({d.r, d.g, d.b});
    return sum_of_gaussians(density, glm::dvec3(1), narrowest_mm, widest_mm, name);
}

} // namespace renderer::optics
