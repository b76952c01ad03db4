// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/optics/dipole.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <support/error.h>

#include "expansion.h"

namespace renderer::optics {
namespace {

// [Jensen2001, Figure 5]
const std::map<std::string, Dipole, std::less<>> media{
    {"skin1", {{0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, 1.3}},
    {"skin2", {{1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, 1.3}},
    {"marble", {{2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, 1.5}},
    {"ketchup", {{0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, 1.3}},
    {"skimmilk", {{0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, 1.3}},
    {"wholemilk", {{2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, 1.3}},
    {"cream", {{7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, 1.3}},
};

glm::dvec3 sigma_t_prime(const Dipole& dipole) { return dipole.sigma_s_prime_per_mm + dipole.sigma_a_per_mm; }
glm::dvec3 albedo_prime(const Dipole& dipole) { return dipole.sigma_s_prime_per_mm / sigma_t_prime(dipole); }
glm::dvec3 sigma_tr(const Dipole& dipole) {
    return glm::sqrt(3.0 * dipole.sigma_a_per_mm * sigma_t_prime(dipole));
}

} // namespace

Dipole measured_medium(std::string_view name) {
    const auto found = media.find(name);
    if (found == media.end()) {
        std::string names;
        for (const auto& [known, medium] : media) {
            names += (names.empty() ? "" : ", ") + known;
        }
        throw support::input_error("medium: expected one of {}, found {}", names,
                                   support::one_line(std::string(name)));
    }
    return found->second;
}

SourceDepths source_depths(const Dipole& dipole) {
    // The mismatch of the indices reflects light inwards, which moves the virtual source [Jensen2001,
    // section 2].
    const double eta = dipole.eta;
    const double inward = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
    const double mismatch = (1 + inward) / (1 - inward);
    const glm::dvec3 real_mm = 1.0 / sigma_t_prime(dipole);
    return {real_mm, real_mm * (1 + 4 * mismatch / 3)};
}

glm::dvec3 source_reflectance(const Dipole& dipole, const glm::dvec3& depth_mm, double r_mm) {
    const glm::dvec3 d = glm::sqrt(r_mm * r_mm + depth_mm * depth_mm);
    const glm::dvec3 attenuation = sigma_tr(dipole) * d;
    return albedo_prime(dipole) / (4 * std::numbers::pi) * depth_mm * (1.0 + attenuation) *
           glm::exp(-attenuation) / (d * d * d);
}

glm::dvec3 diffuse_reflectance(const Dipole& dipole, double r_mm) {
    const SourceDepths depths = source_depths(dipole);
    return source_reflectance(dipole, depths.real_mm, r_mm) +
           source_reflectance(dipole, depths.virtual_mm, r_mm);
}

glm::dvec3 total_reflectance(const Dipole& dipole) {
    // Over the plane, z (1 + sigma d) exp(-sigma d) / d^3 integrates to 2 pi exp(-sigma z).
    const SourceDepths depths = source_depths(dipole);
    const glm::dvec3 sigma = sigma_tr(dipole);
    return 0.5 * albedo_prime(dipole) *
           (glm::exp(-sigma * depths.real_mm) + glm::exp(-sigma * depths.virtual_mm));
}

Profile expanded(const Dipole& dipole, std::string_view name) {
    // exp(-sigma d) / d = 2 / sqrt(pi) * integral over t of exp(-d^2 t^2 - sigma^2 / 4t^2); its derivative in
    // z makes z (1 + sigma d) exp(-sigma d) / d^3 an integral of exp(-r^2 t^2), a Gaussian of variance
    // 1 / 2t^2. So each source has energy at t with the density
    // alpha' z / sqrt(pi) * exp(-z^2 t^2 - sigma^2 / 4t^2).
    const SourceDepths depths = source_depths(dipole);
    const glm::dvec3 sigma = sigma_tr(dipole);
    const auto density = [&](double t) {
        glm::dvec3 sum{0};
        for (const glm::dvec3& z : {depths.real_mm, depths.virtual_mm}) {
            sum += z * glm::exp(-z * z * t * t - sigma * sigma / (4 * t * t));
        }
        return sum * albedo_prime(dipole) / std::sqrt(std::numbers::pi);
    };
    const glm::dvec3 z = depths.real_mm;
    const double narrowest_mm = 0.15 * std::min({z.r, z.g, z.b});
    // Without absorption the tail would have no end.
    const double widest_mm =
        std::min(8 / std::min({sigma.r, sigma.g, sigma.b}), 1000 * std::max({z.r, z.g, z.b}));
    return sum_of_gaussians(density, total_reflectance(dipole), narrowest_mm, widest_mm, name);
}

} // namespace renderer::optics
