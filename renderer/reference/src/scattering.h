// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <renderer/optics/profile.h>

#include "light_tree.h"
#include "skin.h"
#include "view.h"

namespace renderer::reference {

/// Where a ray of a pixel meets the surface.
struct Hit {
    Place place;
    SkinPoint point;
    Reached reached;
    glm::vec3 entering{0};   ///< light that enters there
    double footprint_mm = 0; ///< of the pixel
    std::uint32_t pixel = 0; ///< any number that pixels differ in
};

/// Light that leaves where it did not enter: the profile's Gaussians one by one, wide ones summed over the
/// cells of the tree, narrow ones sampled around the hit.
class Scattering {
public:
    Scattering(const Geometry& geometry, const Skin& skin, const View& view, const scene::Light& light,
               const optics::Profile& profile, const LightTree& tree, std::size_t samples);

    /// The scattered light at each hit, at most `samples` a pixel; hits of one pixel stand together.
    std::vector<glm::vec3> scattered(std::span<const Hit> hits) const;

private:
    /// Hits that are so near each other that one sum does for all.
    struct Query {
        glm::vec3 place_mm{0};  ///< centroid
        float variance_mm2 = 0; ///< of the hits about it
        std::vector<std::uint32_t> hits;
    };
    std::vector<Query> queries(std::span<const Hit> hits, double sigma_mm) const;
    void add_queries_of_pixel(std::span<const Hit> hits, std::size_t first, std::size_t last, double sigma_mm,
                              std::vector<Query>& queries) const;
    void sum_over_cells(std::vector<Query>& queries, const optics::Gaussian& gaussian, double footprint_mm,
                        std::vector<glm::vec3>& result) const;
    void sample_around(std::span<const Hit> hits, const optics::Gaussian& gaussian,
                       std::vector<glm::vec3>& result) const;
    glm::vec3 entering_beside(const Hit& hit, double sigma_mm, const glm::dvec2& random) const;

    const Geometry& geometry_;
    const Skin& skin_;
    const View& view_;
    const scene::Light& light_;
    const optics::Profile& profile_;
    const LightTree& tree_;
    std::vector<std::vector<glm::dvec2>> spreads_; ///< of a pixel's samples over narrow Gaussians
};

} // namespace renderer::reference
