// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_crossing.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

namespace stimuli::head {
namespace {

using Corners = std::array<glm::vec3, 3>;

/// Whether a segment passes through a triangle's inside. [MoellerTrumbore1997]
bool pierces(glm::dvec3 from, glm::dvec3 to, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 direction = to - from, side = glm::cross(direction, c - a);
    const double determinant = glm::dot(b - a, side);
    if (std::abs(determinant) < 1e-12) {
        return false;
    }
    // Leave out touches within rounding: single precision holds a place of 200 mm to 2e-5 mm.
    constexpr double margin = 1e-4;
    const glm::dvec3 rel = from - a, normal = glm::cross(rel, b - a);
    const double u = glm::dot(rel, side) / determinant, v = glm::dot(direction, normal) / determinant;
    const double along = glm::dot(c - a, normal) / determinant;
    return u > margin && v > margin && u + v < 1 - margin && along > margin && along < 1 - margin;
}

bool touch(const Corners& a, const Corners& b) {
    for (const glm::vec3& corner : a) {
        if (corner == b[0] || corner == b[1] || corner == b[2]) {
            return true;
        }
    }
    return false;
}

} // namespace

std::optional<glm::vec3> crossing(const renderer::scene::Mesh& mesh) {
    // Enter each triangle into the cells of space that its box meets.
    constexpr float cell_mm = 5;
    std::vector<Corners> triangles;
    std::map<std::tuple<int, int, int>, std::vector<std::size_t>> cells;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position_mm; };
        const Corners corners{corner(0), corner(1), corner(2)};
        const glm::ivec3 low(glm::floor(glm::min(glm::min(corners[0], corners[1]), corners[2]) / cell_mm));
        const glm::ivec3 high(glm::floor(glm::max(glm::max(corners[0], corners[1]), corners[2]) / cell_mm));
        for (int x = low.x; x <= high.x; ++x) {
            for (int y = low.y; y <= high.y; ++y) {
                for (int z = low.z; z <= high.z; ++z) {
                    cells[{x, y, z}].push_back(triangles.size());
                }
            }
        }
        triangles.push_back(corners);
    }

    // Try the edges of each triangle on all others in its cells.
    for (const auto& [cell, inside] : cells) {
        for (const std::size_t s : inside) {
            for (const std::size_t t : inside) {
                const Corners &a = triangles[s], &b = triangles[t];
                if (touch(a, b)) {
                    continue;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    if (pierces(a[k], a[(k + 1) % 3], b[0], b[1], b[2])) {
                        return a[k];
                    }
                }
            }
        }
    }
    return std::nullopt;
}

} // namespace stimuli::head
