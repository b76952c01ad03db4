// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include <renderer/scene/camera.h>
#include <renderer/scene/model.h>

namespace renderer::passes {

/// A rectangle of pixels, origin at the lower left.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;

    bool empty() const { return width <= 0 || height <= 0; }
    bool operator==(const PixelRect&) const = default;
};

/// All directions whose cosine with the axis is at least that given; -1: any direction.
struct Cone {
    glm::vec3 axis{0, 0, 1};
    float least_cosine = -1;
};

/// A run of a mesh's triangles, to decide on them all at once.
struct Cluster {
    std::uint32_t first = 0, count = 0; ///< indices
    scene::Bounds box;
    Cone facets;  ///< normals of the triangles' planes
    Cone normals; ///< normals of their vertices, which the light is computed with
};

/// Cut a mesh into clusters, in the order of its indices.
std::vector<Cluster> clusters_of(const scene::Mesh& mesh);

/// A camera's frustum.
class Frustum {
public:
    explicit Frustum(const scene::Camera& camera);
    /// Whether the camera may see something in the box: only if this is true.
    bool may_see(const scene::Bounds& box) const;
    /// Depths of a box: of its nearest and its farthest corner, millimetres; below 0 behind the camera.
    glm::vec2 depths_mm(const scene::Bounds& box) const;
    /// The pixels that can show the box, rounded outwards; all of them if it reaches behind the camera.
    PixelRect rect(const scene::Bounds& box) const;
    const glm::vec3& eye_mm() const { return camera_.eye_mm; }

private:
    scene::Camera camera_;
    glm::mat3 rotation_;
    glm::vec2 tangents_; ///< of half the field of view, along x and y
};

/// Whether all triangles of the cluster show their back to the eye.
bool turned_away(const Cluster& cluster, const glm::vec3& eye_mm);
/// Whether light from a direction reaches any of the cluster's triangles, shadows apart: not if this is
/// false.
bool may_light(const Cluster& cluster, const glm::vec3& direction);

/// The smallest rectangle that holds both.
PixelRect united(const PixelRect& a, const PixelRect& b);

} // namespace renderer::passes
