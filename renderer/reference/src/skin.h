// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <bitset>
#include <vector>

#include <glm/glm.hpp>

#include <renderer/scene/appearance.h>

#include "geometry.h"
#include "textures.h"

namespace renderer::reference {

/// All that light needs to know of a place on the skin.
struct SkinPoint {
    glm::dvec3 position_mm{0};
    glm::dvec3 lifted_mm{0}; ///< on the smooth surface that the normals tell of: where shadow rays start
    glm::vec3 normal{0};     ///< interpolated, of the side that is seen
    glm::vec3 mapped{0};     ///< normal with the normal map
    glm::vec3 color{0};      ///< albedo, linear Rec. 709
    float slope = 0;         ///< Beckmann's m
    float specular = 0;      ///< what the reflection is multiplied with
    std::size_t material = 0;
};

/// Bit k: beam k of the light is seen from a point.
using Reached = std::bitset<scene::most_beams>;

/// The materials of a model under a look, and their light: the equations of material.glsl and lit.frag,
/// without filters of textures and shadows.
class Skin {
public:
    Skin(const Geometry& geometry, const scene::Look& look);

    /// `eye_mm` decides which side of double-sided materials is meant.
    SkinPoint point(const Place& place, const glm::dvec3& eye_mm) const;
    /// Which of the beams reach the point, none from which the interpolated normal faces away.
    Reached lit(const SkinPoint& point, const scene::Light& light) const;
    /// Light that enters, with the part of the colour that is applied before scattering, as the radiance that
    /// it would leave with.
    glm::vec3 entering(const SkinPoint& point, const scene::Light& light, const Reached& reached) const;
    /// What scattered light is multiplied with as it leaves towards the unit vector V.
    glm::vec3 leaving(const SkinPoint& point, const glm::vec3& V) const;
    /// Radiance reflected off the surface towards V.
    glm::vec3 reflected(const SkinPoint& point, const scene::Light& light, const glm::vec3& V,
                        const Reached& reached) const;

private:
    struct Material {
        Texture base_color, normal, roughness, specular;
        glm::vec3 base_color_factor{1};
        float normal_scale = 1, roughness_factor = 1, specular_factor = 1;
        bool double_sided = false;
        /// Specular albedo by cosine, a row for each slope in `slopes`.
        std::vector<float> slopes, specular_albedo;
    };
    glm::vec3 mapped_normal(const Material& material, const glm::vec3& N, const glm::vec4& tangent,
                            const glm::vec2& uv) const;
    float specular_albedo(const SkinPoint& point, float NoX) const;
    void tabulate_specular_albedo(Material& material) const;

    const Geometry& geometry_;
    scene::Look look_;
    std::vector<Material> materials_;
};

} // namespace renderer::reference
