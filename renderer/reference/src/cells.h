// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "sampling_plan.h"
#include "skin.h"

namespace renderer::reference {

/// A symmetric matrix: the covariance of light about its centroid, square millimetres.
struct Covariance {
    glm::vec3 diagonal{0};     ///< xx, yy, zz
    glm::vec3 off_diagonal{0}; ///< xy, yz, zx

    /// Of a single displacement.
    static Covariance of(const glm::vec3& d) { return {d * d, d * glm::vec3(d.y, d.z, d.x)}; }
    void add(const Covariance& other, float weight) {
        diagonal += other.diagonal * weight;
        off_diagonal += other.off_diagonal * weight;
    }
    float trace() const { return diagonal.x + diagonal.y + diagonal.z; }
};

/// A piece of the surface and the light that enters it; or several, taken together.
struct Cell {
    glm::vec3 place_mm{0}; ///< centroid of the light
    glm::vec3 light{0};    ///< entering light times area
    Covariance covariance; ///< of the light about its centroid

    float total() const { return light.r + light.g + light.b; }
};

/// Cut the model into cells as the plan asks; if they would be more than `most` and one for each triangle,
/// into larger ones. None of those returned is dark. Throws support::InputError if they would have to be so
/// large that they do not resolve the profile.
std::vector<Cell> lit_cells(const Geometry& geometry, const Skin& skin, const View& view,
                            const scene::Light& light, const SamplingPlan& plan, std::size_t most);

} // namespace renderer::reference
