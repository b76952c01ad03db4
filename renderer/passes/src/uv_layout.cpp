// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "uv_layout.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace renderer::passes {
namespace {

using Triangle = std::array<const scene::Vertex*, 3>;

Triangle triangle_of(const scene::Mesh& mesh, std::size_t number) {
    Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = &mesh.vertices[mesh.indices[3 * number + k]];
    }
    return corners;
}

std::size_t triangle_count(const scene::Mesh& mesh) { return mesh.indices.size() / 3; }

/// Lengths of edges may differ by this share of the triangle, which does not show.
constexpr float edge_slack = 1e-3f;
/// And by what rounding does to places, as a share of their distance from the origin.
constexpr float place_slack = 1e-6f;
/// Of the map's side: no light comes from farther.
constexpr float widest_margin = 0.375f;
/// What rounding may do to a cosine or to a place in the frustum.
constexpr float slack = 1e-3f;

/// A triangle on the surface and in the map.
struct Measured {
    glm::vec2 map_per_mm{0};
    float area_mm2 = 0, map_area = 0;
};

Measured measure(const Triangle& corners, const glm::vec2& uv_scale) {
    glm::vec2 sides[3];
    glm::vec3 edges_mm[3];
    Measured measured;
    for (std::size_t k = 0; k < 3; ++k) {
        sides[k] = (corners[(k + 1) % 3]->uv - corners[k]->uv) * uv_scale;
        edges_mm[k] = corners[(k + 1) % 3]->position_mm - corners[k]->position_mm;
        measured.map_per_mm =
            glm::max(measured.map_per_mm, glm::abs(sides[k]) / std::max(glm::length(edges_mm[k]), 1e-6f));
    }
    measured.area_mm2 = 0.5f * glm::length(glm::cross(edges_mm[0], edges_mm[1]));
    measured.map_area = 0.5f * std::abs(sides[0].x * sides[1].y - sides[0].y * sides[1].x);
    return measured;
}

bool same_edges(const Triangle& a, const Triangle& b) {
    glm::vec3 lengths_a, lengths_b;
    float farthest_mm = 0;
    for (int k = 0; k < 3; ++k) {
        const auto from = static_cast<std::size_t>(k);
        const auto to = (from + 1) % 3;
        lengths_a[k] = glm::distance(a[from]->position_mm, a[to]->position_mm);
        lengths_b[k] = glm::distance(b[from]->position_mm, b[to]->position_mm);
        farthest_mm =
            std::max({farthest_mm, glm::length(a[from]->position_mm), glm::length(b[from]->position_mm)});
    }
    const float longest_mm = std::max({lengths_a.x, lengths_a.y, lengths_a.z});
    return glm::all(glm::lessThanEqual(glm::abs(lengths_a - lengths_b),
                                       glm::vec3(edge_slack * longest_mm + place_slack * farthest_mm)));
}

bool lie_alike(const scene::Mesh& a, const scene::Mesh& b) {
    const auto same_uv = [](const scene::Vertex& v, const scene::Vertex& w) { return v.uv == w.uv; };
    if (a.indices != b.indices ||
        !std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), same_uv)) {
        return false;
    }
    for (std::size_t t = 0; t < triangle_count(a); ++t) {
        if (!same_edges(triangle_of(a, t), triangle_of(b, t))) {
            return false;
        }
    }
    return true;
}

/// Whether a camera may see the triangles of a mesh.
class Sight {
public:
    Sight(const scene::Mesh& mesh, const scene::Camera& camera, bool both_sides)
        : mesh_(mesh), eye_mm_(camera.eye_mm), both_sides_(both_sides) {
        // Mark the planes of the frustum that each vertex lies beyond.
        const glm::mat3 rotation = camera.rotation();
        const float tan_y = std::tan(0.5f * camera.fov_rad) * (1 + slack);
        const float tan_x = tan_y * static_cast<float>(camera.width) / static_cast<float>(camera.height);
        beyond_.reserve(mesh.vertices.size());
        for (const scene::Vertex& vertex : mesh.vertices) {
            const glm::vec3 p = rotation * (vertex.position_mm - eye_mm_);
            beyond_.push_back(static_cast<std::uint8_t>(
                (p.z >= 0 ? 1 : 0) | (p.x > -p.z * tan_x ? 2 : 0) | (p.x < p.z * tan_x ? 4 : 0) |
                (p.y > -p.z * tan_y ? 8 : 0) | (p.y < p.z * tan_y ? 16 : 0)));
        }
    }

    bool may_see(std::size_t triangle) const {
        const std::uint32_t* index = &mesh_.indices[3 * triangle];
        if ((beyond_[index[0]] & beyond_[index[1]] & beyond_[index[2]]) != 0) {
            return false;
        }
        if (both_sides_) {
            return true;
        }
        const Triangle corners = triangle_of(mesh_, triangle);
        const glm::vec3 across = glm::cross(corners[1]->position_mm - corners[0]->position_mm,
                                            corners[2]->position_mm - corners[0]->position_mm);
        const glm::vec3 to_eye = eye_mm_ - corners[0]->position_mm;
        return glm::dot(across, to_eye) > -slack * glm::length(across) * glm::length(to_eye);
    }

private:
    const scene::Mesh& mesh_;
    glm::vec3 eye_mm_;
    bool both_sides_;
    std::vector<std::uint8_t> beyond_;
};

/// Mark all blocks that a triangle's surroundings may touch.
void mark(std::vector<std::uint8_t>& wanted, int blocks, const Triangle& corners, const UvLayout& layout,
          const glm::vec2& margin) {
    const glm::vec2 a = (corners[0]->uv - layout.uv_origin) * layout.uv_scale;
    const glm::vec2 b = (corners[1]->uv - layout.uv_origin) * layout.uv_scale;
    const glm::vec2 c = (corners[2]->uv - layout.uv_origin) * layout.uv_scale;
    const auto side = static_cast<float>(blocks);
    const glm::ivec2 last(blocks - 1);
    const glm::ivec2 low = glm::clamp(glm::ivec2(glm::floor((glm::min(glm::min(a, b), c) - margin) * side)),
                                      glm::ivec2(0), last);
    const glm::ivec2 high = glm::clamp(glm::ivec2(glm::floor((glm::max(glm::max(a, b), c) + margin) * side)),
                                       glm::ivec2(0), last);
    for (int y = low.y; y <= high.y; ++y) {
        const auto row = wanted.begin() + static_cast<std::ptrdiff_t>(y) * blocks;
        std::fill(row + low.x, row + high.x + 1, std::uint8_t{1});
    }
}

} // namespace

UvLayout uv_layout(const scene::Model& model, std::size_t material) {
    // Fit coordinates that leave the unit square into the map; others are used as they are.
    UvLayout layout;
    glm::vec2 low(0);
    glm::vec2 high(1);
    for (std::size_t i = 0; i < model.meshes.size(); ++i) {
        if (model.meshes[i].material == material) {
            layout.meshes.push_back(i);
            for (const scene::Vertex& vertex : model.meshes[i].vertices) {
                low = glm::min(low, vertex.uv);
                high = glm::max(high, vertex.uv);
            }
        }
    }
    layout.uv_origin = low;
    layout.uv_scale = 1.0f / (high - low);

    // Measure each triangle on the surface and in the map.
    double area_mm2 = 0;
    double map_area = 0;
    for (const std::size_t i : layout.meshes) {
        std::vector<glm::vec2>& map_per_mm = layout.map_per_mm.emplace_back();
        for (std::size_t t = 0; t < triangle_count(model.meshes[i]); ++t) {
            const Measured measured = measure(triangle_of(model.meshes[i], t), layout.uv_scale);
            map_per_mm.push_back(measured.map_per_mm);
            area_mm2 += static_cast<double>(measured.area_mm2);
            map_area += static_cast<double>(measured.map_area);
        }
    }
    layout.side_mm = map_area > 0 ? static_cast<float>(std::sqrt(area_mm2 / map_area)) : 0;
    return layout;
}

bool lie_alike(const scene::Model& model, const UvLayout& a, const UvLayout& b) {
    return std::equal(
        a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(),
        [&](std::size_t i, std::size_t j) { return lie_alike(model.meshes[i], model.meshes[j]); });
}

int blocks_along(int size) {
    constexpr int texels_a_block = 8;
    return std::max(size / texels_a_block, 1);
}

std::vector<std::uint8_t> wanted_blocks(const scene::Model& source, const GpuModel::View& view,
                                        const scene::Camera& camera, const UvLayout& layout, int size,
                                        float margin_mm) {
    const int blocks = blocks_along(size);
    const float texel = 1.0f / static_cast<float>(size); // filters read beside a place
    std::vector<std::uint8_t> wanted(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks));
    for (const GpuModel::Part& part : view.parts) {
        const auto found = std::find(layout.meshes.begin(), layout.meshes.end(), part.mesh);
        if (found == layout.meshes.end()) {
            continue;
        }
        const std::vector<glm::vec2>& map_per_mm =
            layout.map_per_mm[static_cast<std::size_t>(found - layout.meshes.begin())];
        const scene::Mesh& mesh = source.meshes[part.mesh];
        const Sight sight(mesh, camera, source.materials[mesh.material].double_sided);
        for (const Cluster* cluster : part.clusters) {
            for (std::size_t t = cluster->first / 3; t < (cluster->first + cluster->count) / 3; ++t) {
                if (sight.may_see(t)) {
                    const glm::vec2 margin = glm::min(margin_mm * map_per_mm[t], glm::vec2(widest_margin));
                    mark(wanted, blocks, triangle_of(mesh, t), layout, margin + texel);
                }
            }
        }
    }
    return wanted;
}

} // namespace renderer::passes
