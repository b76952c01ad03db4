// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

namespace renderer::optics {

/// Beckmann's distribution of microfacet slopes, without the factor 1/pi (see specular_reflectance).
/// `m` is the root mean square slope, in (0, 1].
double beckmann(double NoH, double m);

/// Schlick's approximation of the Fresnel reflectance; `f0` at normal incidence.
double schlick(double VoH, double f0);

/// The part of the light from direction theta (cosine `cos_theta`) that a surface of slope `m` reflects
/// specularly: the Kelemen/Szirmay-Kalos BRDF P_H F / (pi |L+V|^2) [KelemenSzirmayKalos2001], times cosine,
/// integrated over the hemisphere by the midpoint rule, for rho_s = 1. In [0, 1].
double specular_albedo(double cos_theta, double m, double f0);

/// specular_albedo on a grid: `size` cosines from 0 to 1 in a row, one row for each of `size` slopes from
/// 1/size to 1.
std::vector<float> specular_albedo_table(int size, double f0);

} // namespace renderer::optics
