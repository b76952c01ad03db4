// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "uv_charts.h"

#include <array>
#include <map>
#include <numeric>

namespace renderer::passes {
namespace {

/// Sets of corners, merged as triangles join them.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace

std::vector<std::uint32_t> chart_of_triangle(const scene::Mesh& mesh) {
    DisjointSets sets(mesh.vertices.size());
    // Vertices that differ in their normals alone are one corner.
    std::map<std::array<float, 5>, std::uint32_t> corners;
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        const scene::Vertex& v = mesh.vertices[i];
        const std::array<float, 5> key{v.position_mm.x, v.position_mm.y, v.position_mm.z, v.uv.x, v.uv.y};
        const auto [found, added] = corners.emplace(key, i);
        if (!added) {
            sets.join(i, found->second);
        }
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        sets.join(mesh.indices[i], mesh.indices[i + 1]);
        sets.join(mesh.indices[i], mesh.indices[i + 2]);
    }
    std::map<std::uint32_t, std::uint32_t> number_of_root;
    std::vector<std::uint32_t> charts;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto next = static_cast<std::uint32_t>(number_of_root.size());
        charts.push_back(number_of_root.emplace(sets.root(mesh.indices[i]), next).first->second);
    }
    return charts;
}

std::vector<Texel> nearest_covered(const std::vector<bool>& covered, int size, int reach) {
    std::vector<Texel> nearest(covered.size());
    std::vector<Texel> front;
    const auto index = [size](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
    };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (covered[index(x, y)]) {
                const Texel self{static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
                nearest[index(x, y)] = self;
                front.push_back(self);
            }
        }
    }
    // Grow all charts by one ring of texels a step.
    for (int step = 0; step < reach; ++step) {
        std::vector<Texel> next;
        for (const Texel& at : front) {
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int x = at.x + dx;
                    const int y = at.y + dy;
                    if (x >= 0 && y >= 0 && x < size && y < size && nearest[index(x, y)].x < 0) {
                        nearest[index(x, y)] = nearest[index(at.x, at.y)];
                        next.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
                    }
                }
            }
        }
        front = std::move(next);
    }
    return nearest;
}

} // namespace renderer::passes
