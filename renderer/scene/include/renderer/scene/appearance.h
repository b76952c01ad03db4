// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

namespace renderer::scene {

/// Parallel rays.
struct Beam {
    glm::vec3 direction{0, 0, 1}; ///< unit vector towards the light
    glm::vec3 irradiance{0};      ///< of a surface that faces it, linear Rec. 709

    bool operator==(const Beam&) const = default;
};

/// The light of an image: one or more lights so far away that their rays are parallel, and what comes from
/// all around.
struct Light : Beam {
    std::vector<Beam> further;       ///< beside the first; at most most_beams in all
    glm::vec3 ambient_irradiance{0}; ///< from above, of a surface that faces up; none from below
    int shadow_map_size = 512;       ///< texels a side
    float shadow_softness_mm = 1;    ///< standard deviation of the filter at the shadow's edge

    std::vector<Beam> beams() const {
        std::vector<Beam> all{*this};
        all.insert(all.end(), further.begin(), further.end());
        return all;
    }

    bool operator==(const Light&) const = default;
};
constexpr std::size_t most_beams = 8;

/// All that is the same for all shaders, so that only the method of scattering differs.
struct Look {
    optics::Profile profile;
    float texture_mix = 0.5f; ///< exponent of the albedo before scattering; 1 minus it is left for after
    float specular_intensity = 0.18f; ///< rho_s
    float fresnel_f0 = 0.028f;
    float roughness = 0.3f;   ///< Beckmann slope where the model has none
    float bloom_strength = 0; ///< share of the light that the lens spreads, 0 to 1
    float bloom_sigma_px = 8; ///< standard deviation
    float aperture_mm = 0;    ///< diameter of the lens; 0: all is sharp
    float focus_mm = 0;       ///< distance that is sharp; 0: where the camera looks
    float exposure = 1;
    glm::vec3 background{0}; ///< linear Rec. 709
    int samples = 4;         ///< MSAA samples a pixel
};

} // namespace renderer::scene
