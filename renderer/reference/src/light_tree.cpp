// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "light_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace renderer::reference {
namespace {

constexpr int code_bits = 21; // along each axis
// Nodes are at most so many standard deviations across for the Gaussian that is summed over them.
constexpr double widest_node = 0.7;

/// Put two zeros before each of the low 21 bits.
std::uint64_t spaced(std::uint64_t x) {
    x &= 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

/// A cell's place along the octree's curve [Morton1966].
struct Key {
    std::uint64_t code = 0;
    std::uint32_t index = 0;
    bool operator<(const Key& other) const {
        return code != other.code ? code < other.code : index < other.index;
    }
};

} // namespace

/// What one gathering looks for.
struct LightTree::Visit {
    std::size_t level;
    const Box& box;
    float reach_mm;
    Sources& sources;

    float squared_distance(const glm::vec3& p) const {
        const glm::vec3 d = glm::max(glm::max(box.low - p, p - box.high), glm::vec3(0));
        return glm::dot(d, d);
    }
};

LightTree::LightTree(std::vector<Cell> cells, double narrowest_sigma_mm) {
    // Find the cube around the cells.
    Box box;
    for (const Cell& cell : cells) {
        box.include(cell.place_mm);
    }
    const glm::vec3 extent = cells.empty() ? glm::vec3(0) : box.high - box.low;
    const double side =
        std::max(static_cast<double>(std::max({extent.x, extent.y, extent.z})), 1e-6) * 1.0001;

    // Sort the cells along the curve.
    std::vector<Key> keys(cells.size());
    const double steps = static_cast<double>(std::uint64_t{1} << code_bits) / side;
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
        const glm::dvec3 p = glm::dvec3(cells[i].place_mm - box.low) * steps;
        keys[i] = {spaced(static_cast<std::uint64_t>(p.x)) | spaced(static_cast<std::uint64_t>(p.y)) << 1 |
                       spaced(static_cast<std::uint64_t>(p.z)) << 2,
                   static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(keys.begin(), keys.end());
    Level leaves;
    leaves.nodes.resize(cells.size());
    std::vector<std::uint64_t> codes(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
        leaves.nodes[i].cell = cells[keys[i].index];
        codes[i] = keys[i].code;
    });
    cells = {};
    keys = {};

    // The finest cubes are wider than the narrowest Gaussian: that one uses the cells themselves.
    int depth = 0;
    while (depth < code_bits && side / static_cast<double>(2 << depth) > widest_node * narrowest_sigma_mm) {
        ++depth;
    }
    levels_.push_back(std::move(leaves));
    for (int shift = 3 * (code_bits - depth); shift <= 3 * code_bits; shift += 3) {
        for (std::uint64_t& code : codes) {
            code >>= shift == 3 * (code_bits - depth) ? shift : 3;
        }
        Level level = parents(levels_.back(), codes);
        level.side_mm = side / static_cast<double>(std::uint64_t{1} << (code_bits - shift / 3));
        codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
        levels_.push_back(std::move(level));
    }
    std::reverse(levels_.begin(), levels_.end());
}

LightTree::Level LightTree::parents(const Level& children, const std::vector<std::uint64_t>& codes) const {
    Level level;
    for (std::size_t first = 0; first < codes.size();) {
        std::size_t last = first;
        double total = 0;
        glm::dvec3 moment(0);
        glm::dvec3 light(0);
        for (; last < codes.size() && codes[last] == codes[first]; ++last) {
            const Cell& cell = children.nodes[last].cell;
            const auto weight = static_cast<double>(cell.total());
            moment += glm::dvec3(cell.place_mm) * weight;
            light += glm::dvec3(cell.light);
            total += weight;
        }
        Node node;
        node.first = static_cast<std::uint32_t>(first);
        node.cell.light = glm::vec3(light);
        node.cell.place_mm = glm::vec3(moment / total);
        for (std::size_t i = first; i < last; ++i) {
            const Node& child = children.nodes[i];
            const glm::vec3 d = child.cell.place_mm - node.cell.place_mm;
            const auto share = static_cast<float>(static_cast<double>(child.cell.total()) / total);
            node.cell.covariance.add(child.cell.covariance, share);
            node.cell.covariance.add(Covariance::of(d), share);
            node.radius_mm = std::max(node.radius_mm, glm::length(d) * 1.0001f + child.radius_mm);
        }
        level.nodes.push_back(node);
        first = last;
    }
    return level;
}

std::size_t LightTree::level_for(double sigma_mm) const {
    std::size_t level = 0;
    while (level + 1 < levels_.size() && levels_[level].side_mm > widest_node * sigma_mm) {
        ++level;
    }
    return level;
}

void LightTree::visit(const Visit& v, std::size_t level, std::uint32_t first, std::uint32_t last) const {
    const std::vector<Node>& nodes = levels_[level].nodes;
    for (std::uint32_t i = first; i < last; ++i) {
        const Node& node = nodes[i];
        const float reach = level == v.level ? v.reach_mm : v.reach_mm + node.radius_mm;
        if (v.squared_distance(node.cell.place_mm) > reach * reach) {
            continue;
        }
        if (level == v.level) {
            v.sources.add(node.cell);
        } else {
            const std::uint32_t end = i + 1 < nodes.size()
                                          ? nodes[i + 1].first
                                          : static_cast<std::uint32_t>(levels_[level + 1].nodes.size());
            visit(v, level + 1, node.first, end);
        }
    }
}

void LightTree::gather(std::size_t level, const Box& box, float reach_mm, Sources& sources) const {
    sources.clear();
    visit({level, box, reach_mm, sources}, 0, 0, static_cast<std::uint32_t>(levels_[0].nodes.size()));
    sources.pad();
}

} // namespace renderer::reference
