// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/optics/profile.h>

#include <cmath>
#include <numbers>

#include <support/error.h>

namespace renderer::optics {
namespace {

// [DEonLuebke2007]: six Gaussians for the three-layer skin of [DonnerJensen2005].
const std::vector<Gaussian> skin_6g{
    {0.0064, {0.233, 0.455, 0.649}}, {0.0484, {0.100, 0.336, 0.344}}, {0.187, {0.118, 0.198, 0.000}},
    {0.567, {0.113, 0.007, 0.007}},  {1.99, {0.358, 0.004, 0.000}},   {7.41, {0.078, 0.000, 0.000}},
};

// [JimenezGutierrez2010, Table 7.1]
const std::vector<Gaussian> skin_4g{
    {0.0064, {0.2405, 0.4474, 0.6157}},
    {0.0516, {0.1158, 0.3661, 0.3439}},
    {0.2719, {0.1836, 0.1864, 0.0}},
    {2.0062, {0.46, 0.0, 0.0402}},
};
const std::vector<Gaussian> marble_4g{
    {0.0362, {0.0544, 0.1245, 0.2177}},
    {0.1144, {0.2436, 0.2435, 0.1890}},
    {0.4555, {0.3105, 0.3158, 0.3742}},
    {3.4833, {0.3913, 0.3161, 0.2189}},
};

} // namespace

Profile profile(std::string_view name) {
    Profile result{std::string(name), {}};
    if (name == "skin_6g_deon2007") {
        result.gaussians = skin_6g;
    } else if (name == "skin_4g_jimenez2010") {
        result.gaussians = skin_4g;
    } else if (name == "marble_4g_jimenez2010") {
        result.gaussians = marble_4g;
    } else {
        throw support::input_error("profile: expected skin_6g_deon2007, skin_4g_jimenez2010 or "
                                   "marble_4g_jimenez2010, found {}",
                                   name);
    }
    glm::dvec3 sum{0};
    for (const Gaussian& g : result.gaussians) {
        sum += g.weight;
    }
    for (Gaussian& g : result.gaussians) {
        g.weight /= sum;
    }
    return result;
}

glm::dvec3 diffuse_reflectance(const Profile& profile, double r_mm) {
    glm::dvec3 sum{0};
    for (const Gaussian& g : profile.gaussians) {
        const double v = g.variance_mm2;
        sum += g.weight * (std::exp(-r_mm * r_mm / (2 * v)) / (2 * std::numbers::pi * v));
    }
    return sum;
}

glm::dvec3 rms_radius_mm(const Profile& profile) {
    // A 2D Gaussian of variance v per axis has the mean square radius 2v.
    glm::dvec3 sum{0};
    for (const Gaussian& g : profile.gaussians) {
        sum += 2 * g.variance_mm2 * g.weight;
    }
    return glm::sqrt(sum);
}

std::vector<double> cascade_sigmas_mm(const Profile& profile) {
    // Variances add when Gaussians are convolved.
    std::vector<double> sigmas;
    double reached_mm2 = 0;
    for (const Gaussian& g : profile.gaussians) {
        sigmas.push_back(std::sqrt(g.variance_mm2 - reached_mm2));
        reached_mm2 = g.variance_mm2;
    }
    return sigmas;
}

} // namespace renderer::optics
