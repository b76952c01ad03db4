// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

#include "view.h"

namespace renderer::reference {

/// A Gaussian narrower than this share of a pixel's footprint is sampled where the pixel's rays meet the
/// surface; a wider one is summed over cells.
constexpr double narrow_px = 0.15;

/// Light beyond this many standard deviations is left out: exp(-5^2 / 2) = 4e-6 of a Gaussian.
constexpr double reach_sigmas = 5;

/// Where a view needs cells of the surface, and how fine.
class SamplingPlan {
public:
    /// Sends the view's rays, `pattern` in each pixel, to find what it sees.
    SamplingPlan(const Geometry& geometry, const View& view, const std::vector<glm::dvec2>& pattern,
                 const optics::Profile& profile, double cells_per_sigma);

    /// Side of the cells within a ball, or 0 where nothing visible needs them.
    double spacing_mm(const glm::dvec3& centre_mm, double radius_mm) const;
    /// The narrowest Gaussian of the profile that has a width; 0 if none has.
    double narrowest_sigma_mm() const { return sigmas_mm_.empty() ? 0 : sigmas_mm_.front(); }

private:
    void find_visible(const Geometry& geometry, const std::vector<glm::dvec2>& pattern);
    void find_distances();
    void spread(int axis);
    /// At most the distance to anything visible.
    double distance_mm(const glm::dvec3& place_mm) const;
    std::size_t index(const glm::ivec3& voxel) const {
        return static_cast<std::size_t>((voxel.z * size_.y + voxel.y)) * static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(voxel.x);
    }

    const View& view_;
    std::vector<double> sigmas_mm_; ///< ascending
    double cells_per_sigma_;
    glm::dvec3 origin_mm_{0};
    double voxel_mm_ = 0, reach_mm_ = 0;
    std::vector<glm::ivec3> visible_; ///< voxels with something visible
    glm::ivec3 low_{0}, size_{0};     ///< of the dense grid, voxels
    int margin_ = 0;                  ///< of the grid around what is visible, voxels
    std::vector<float> distances_;    ///< squared, voxels
};

} // namespace renderer::reference
