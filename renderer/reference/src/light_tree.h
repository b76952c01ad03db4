// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "cells.h"
#include "gaussian_sum.h"

namespace renderer::reference {

/// An axis-aligned box, millimetres.
struct Box {
    glm::vec3 low{1e30f}, high{-1e30f};
    void include(const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

/// Cells in an octree, each node of which stands for its cells: with their light, its centroid and its
/// covariance, a node agrees with them in the first three moments.
class LightTree {
public:
    LightTree(std::vector<Cell> cells, double narrowest_sigma_mm);

    /// The level whose nodes are fine enough for a Gaussian: at most .7 standard deviations across.
    std::size_t level_for(double sigma_mm) const;
    /// Collect the nodes of a level whose centroids lie within `reach_mm` of the box; what was in `sources`
    /// is dropped.
    void gather(std::size_t level, const Box& box, float reach_mm, Sources& sources) const;

private:
    struct Node {
        Cell cell;
        float radius_mm = 0;     ///< of a ball about the centroid that holds all centroids below
        std::uint32_t first = 0; ///< child in the next level; the next node's is the end
    };
    struct Level {
        double side_mm = 0; ///< of a node's cube; 0: nodes are cells
        std::vector<Node> nodes;
    };
    struct Visit;
    Level parents(const Level& children, const std::vector<std::uint64_t>& codes) const;
    void visit(const Visit& visit, std::size_t level, std::uint32_t first, std::uint32_t last) const;

    std::vector<Level> levels_; ///< from the root to the cells
};

} // namespace renderer::reference
