// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace renderer::optics {

/// One term of a diffusion profile: G(v, r) = exp(-r^2 / 2v) / (2 pi v), times a weight per colour channel.
struct Gaussian {
    double variance_mm2 = 0;
    glm::dvec3 weight{0};
};

/// A diffusion profile R(r) as a sum of Gaussians, variances ascending, weights adding up to 1 in each
/// channel: how much of the light that enters at a point leaves at distance r.
struct Profile {
    std::string name;
    std::vector<Gaussian> gaussians;
};

/// A published profile: skin_6g_deon2007 [DEonLuebke2007], skin_4g_jimenez2010, marble_4g_jimenez2010
/// [JimenezGutierrez2010, Table 7.1]; weights are normalised, so that a profile changes no colour.
/// Throws support::InputError for another name.
Profile profile(std::string_view name);

/// R(r), per mm^2.
glm::dvec3 diffuse_reflectance(const Profile& profile, double r_mm);

/// Root mean square distance between entry and exit, per channel, millimetres: sqrt(2 sum w v).
glm::dvec3 rms_radius_mm(const Profile& profile);

/// Standard deviations of blurs that, one applied after the other, reach the variances of the profile in
/// turn.
std::vector<double> cascade_sigmas_mm(const Profile& profile);

} // namespace renderer::optics
