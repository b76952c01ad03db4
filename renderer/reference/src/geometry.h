// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <glm/glm.hpp>

#include <renderer/scene/model.h>

namespace renderer::reference {

/// A triangle of the model.
struct TriangleId {
    std::uint32_t mesh = 0, triangle = 0;
    bool operator==(const TriangleId&) const = default;
};

/// A place on the model: the weights of the triangle's second and third corner.
struct Place {
    TriangleId id;
    glm::dvec2 weights{0};
};

/// The corners of a triangle, millimetres.
struct Corners {
    glm::dvec3 a{0}, b{0}, c{0};

    glm::dvec3 at(const glm::dvec2& weights) const { return a + (b - a) * weights.x + (c - a) * weights.y; }
    /// Twice the area, along the outer normal.
    glm::dvec3 cross() const { return glm::cross(b - a, c - a); }
    /// Unit length; any unit vector if the triangle is degenerate.
    glm::dvec3 normal() const;
};

/// A ray from `origin_mm` along the unit vector `direction`, between two distances.
struct Ray {
    glm::dvec3 origin_mm{0}, direction{0};
    double nearest_mm = 0, farthest_mm = 1e30;
};

/// The model's triangles, made for rays [Wald2014]. All places are relative to the middle of the model's
/// bounds, so that a model far from the origin loses nothing.
class Geometry {
public:
    /// Throws support::Failure if Embree fails.
    explicit Geometry(scene::Model model);
    ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    /// The nearest triangle that the ray meets; it passes through those of single-sided materials that it
    /// meets from behind.
    std::optional<Place> nearest(const Ray& ray) const;
    /// Whether any triangle, seen from either side, blocks the ray.
    bool blocked(const Ray& ray) const;

    const scene::Model& model() const { return model_; }
    /// The middle of the model's bounds.
    const glm::dvec3& origin_mm() const { return origin_mm_; }
    const scene::Mesh& mesh(TriangleId id) const { return model_.meshes[id.mesh]; }
    const scene::Vertex& vertex(TriangleId id, std::size_t corner) const {
        const scene::Mesh& m = mesh(id);
        return m.vertices[m.indices[std::size_t{3} * id.triangle + corner]];
    }
    Corners corners(TriangleId id) const;
    const scene::Bounds& bounds() const { return bounds_; }
    /// A length that rays must keep off the surface because numbers have an end.
    double epsilon_mm() const { return epsilon_mm_; }

private:
    struct Embree;
    scene::Model model_;
    glm::dvec3 origin_mm_{0};
    scene::Bounds bounds_;
    double epsilon_mm_ = 0;
    std::unique_ptr<Embree> embree_;
};

} // namespace renderer::reference
