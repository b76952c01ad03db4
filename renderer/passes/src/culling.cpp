// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "culling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace renderer::passes {
namespace {

constexpr std::size_t triangles_a_cluster = 256;
// What rounding may do to a cosine or to a place, as a share of its size.
constexpr float slack = 1e-3f;

/// The cone of some unit vectors.
Cone cone_of(const std::vector<glm::vec3>& directions) {
    glm::vec3 sum(0);
    for (const glm::vec3& d : directions) {
        sum += d;
    }
    const float length = glm::length(sum);
    if (!(length > 1e-3f * static_cast<float>(directions.size()))) {
        return {};
    }
    Cone cone{sum / length, 1};
    for (const glm::vec3& d : directions) {
        cone.least_cosine = std::min(cone.least_cosine, glm::dot(cone.axis, d));
    }
    cone.least_cosine -= slack;
    return cone;
}

/// The sine of the cone's half angle, rounded up; only for cones narrower than a half space.
float sine(const Cone& cone) {
    return std::sqrt(std::max(0.0f, 1 - cone.least_cosine * cone.least_cosine)) + slack;
}

glm::vec3 corner_of(const scene::Bounds& box, int i) {
    return {(i & 1) ? box.low.x : box.high.x, (i & 2) ? box.low.y : box.high.y,
            (i & 4) ? box.low.z : box.high.z};
}

} // namespace

std::vector<Cluster> clusters_of(const scene::Mesh& mesh) {
    std::vector<Cluster> clusters;
    std::vector<glm::vec3> facets, normals;
    for (std::size_t first = 0; first + 2 < mesh.indices.size(); first += 3 * triangles_a_cluster) {
        const std::size_t last = std::min(first + 3 * triangles_a_cluster, mesh.indices.size() / 3 * 3);
        Cluster cluster{
            static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first), {}, {}, {}};
        cluster.box = {glm::vec3(std::numeric_limits<float>::infinity()),
                       glm::vec3(-std::numeric_limits<float>::infinity())};
        facets.clear();
        normals.clear();
        for (std::size_t i = first; i < last; i += 3) {
            glm::dvec3 p[3];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const scene::Vertex& vertex = mesh.vertices[mesh.indices[i + corner]];
                p[corner] = vertex.position_mm;
                cluster.box.low = glm::min(cluster.box.low, vertex.position_mm);
                cluster.box.high = glm::max(cluster.box.high, vertex.position_mm);
                normals.push_back(vertex.normal);
            }
            const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double area = glm::length(across);
            if (area > 0) { // else nothing is drawn
                facets.emplace_back(across / area);
            }
        }
        cluster.facets = cone_of(facets);
        cluster.normals = cone_of(normals);
        clusters.push_back(cluster);
    }
    return clusters;
}

Frustum::Frustum(const scene::Camera& camera) : camera_(camera), rotation_(camera.rotation()) {
    const float tangent = std::tan(0.5f * camera.fov_rad);
    tangents_ = {tangent * static_cast<float>(camera.width) / static_cast<float>(camera.height), tangent};
    tangents_ *= 1 + slack;
}

bool Frustum::may_see(const scene::Bounds& box) const {
    // Out of view are boxes with all corners beyond one of the planes.
    int beyond[5] = {};
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p = rotation_ * (corner_of(box, i) - camera_.eye_mm);
        beyond[0] += p.z >= 0 ? 1 : 0;
        beyond[1] += p.x > -p.z * tangents_.x ? 1 : 0;
        beyond[2] += p.x < p.z * tangents_.x ? 1 : 0;
        beyond[3] += p.y > -p.z * tangents_.y ? 1 : 0;
        beyond[4] += p.y < p.z * tangents_.y ? 1 : 0;
    }
    return std::none_of(std::begin(beyond), std::end(beyond), [](int n) { return n == 8; });
}

glm::vec2 Frustum::depths_mm(const scene::Bounds& box) const {
    glm::vec2 depths(std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity());
    for (int i = 0; i < 8; ++i) {
        const float depth = -(rotation_ * (corner_of(box, i) - camera_.eye_mm)).z;
        depths = {std::min(depths.x, depth), std::max(depths.y, depth)};
    }
    return depths;
}

PixelRect Frustum::rect(const scene::Bounds& box) const {
    glm::vec2 low(std::numeric_limits<float>::infinity());
    glm::vec2 high = -low;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p = rotation_ * (corner_of(box, i) - camera_.eye_mm);
        if (p.z >= 0) {
            return {0, 0, camera_.width, camera_.height}; // a corner behind the camera can appear anywhere
        }
        const glm::vec2 pixel =
            glm::vec2(p) / -p.z * camera_.focal_px() +
            0.5f * glm::vec2(static_cast<float>(camera_.width), static_cast<float>(camera_.height));
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    const auto inside = [](float value, int limit) {
        return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(limit)));
    };
    const int left = inside(std::floor(low.x) - 1, camera_.width);
    const int bottom = inside(std::floor(low.y) - 1, camera_.height);
    const int right = inside(std::ceil(high.x) + 1, camera_.width);
    const int top = inside(std::ceil(high.y) + 1, camera_.height);
    return {left, bottom, right - left, top - bottom};
}

bool turned_away(const Cluster& cluster, const glm::vec3& eye_mm) {
    if (cluster.facets.least_cosine <= 0) {
        return false;
    }
    // From the eye, the sphere around the box lies within the cone of directions that see backs alone.
    const glm::vec3 away = 0.5f * (cluster.box.low + cluster.box.high) - eye_mm;
    const float radius = 0.5f * glm::length(cluster.box.high - cluster.box.low);
    return glm::dot(away, cluster.facets.axis) >=
           sine(cluster.facets) * glm::length(away) + radius * (1 + slack);
}

bool may_light(const Cluster& cluster, const glm::vec3& direction) {
    return cluster.normals.least_cosine <= 0 ||
           glm::dot(cluster.normals.axis, direction) > -sine(cluster.normals);
}

PixelRect united(const PixelRect& a, const PixelRect& b) {
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    const int left = std::min(a.x, b.x);
    const int bottom = std::min(a.y, b.y);
    return {left, bottom, std::max(a.x + a.width, b.x + b.width) - left,
            std::max(a.y + a.height, b.y + b.height) - bottom};
}

} // namespace renderer::passes
