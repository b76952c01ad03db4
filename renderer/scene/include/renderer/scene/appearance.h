// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

namespace renderer::scene {

/// A light so far away that its rays are parallel.
struct Light {
    glm::vec3 direction{0, 0, 1};    ///< unit vector towards the light
    glm::vec3 irradiance{0};         ///< of a surface that faces it, linear Rec. 709
    glm::vec3 ambient_irradiance{0}; ///< from above, of a surface that faces up; none from below
    int shadow_map_size = 512;       ///< texels a side
    float shadow_softness_mm = 1;    ///< standard deviation of the filter at the shadow's edge

    bool operator==(const Light&) const = default;
};

/// All that is the same for all shaders, so that only the method of scattering differs.
struct Look {
    optics::Profile profile;
    float texture_mix = 0.5f; ///< exponent of the albedo before scattering; 1 minus it is left for after
    float specular_intensity = 0.18f; ///< rho_s
    float fresnel_f0 = 0.028f;
    float roughness = 0.3f;   ///< Beckmann slope where the model has none
    float bloom_strength = 0; ///< share of the light that the lens spreads, 0 to 1
    float bloom_sigma_px = 8; ///< standard deviation
    float exposure = 1;
    glm::vec3 background{0}; ///< linear Rec. 709
    int samples = 4;         ///< MSAA samples a pixel
};

} // namespace renderer::scene
