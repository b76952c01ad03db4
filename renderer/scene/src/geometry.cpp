// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <renderer/scene/model.h>

#include "place.h"

namespace renderer::scene {
namespace {

/// Call `visit` with the three vertex indices of every triangle.
template <typename Visit>
void each_triangle(const Mesh& mesh, const Visit& visit) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        visit(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
    }
}

/// The angle of triangle abc at a, radians; 0 for a degenerate one.
float angle_at(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 u = b - a;
    const glm::vec3 v = c - a;
    const float lengths = glm::length(u) * glm::length(v);
    return lengths > 0 ? std::acos(std::clamp(glm::dot(u, v) / lengths, -1.0f, 1.0f)) : 0.0f;
}

/// Any unit vector orthogonal to the unit vector n.
glm::vec3 orthogonal(const glm::vec3& n) {
    const glm::vec3 axis = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

} // namespace

Bounds bounds(const Model& model) { return bounds_above(model, -std::numeric_limits<float>::infinity()); }

Bounds bounds_above(const Model& model, float floor_mm) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Bounds result{glm::vec3(infinity), glm::vec3(-infinity)};
    for (const Mesh& mesh : model.meshes) {
        for (const std::uint32_t index : mesh.indices) {
            const glm::vec3& p = mesh.vertices[index].position_mm;
            if (p.y >= floor_mm) {
                result.low = glm::min(result.low, p);
                result.high = glm::max(result.high, p);
            }
        }
    }
    return result;
}

void compute_normals(Mesh& mesh) {
    // Sum each triangle's normal, weighted with its angle, at the place of each corner.
    std::unordered_map<glm::vec3, glm::vec3, PlaceHash> sums;
    each_triangle(mesh, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const glm::vec3& a = mesh.vertices[i].position_mm;
        const glm::vec3& b = mesh.vertices[j].position_mm;
        const glm::vec3& c = mesh.vertices[k].position_mm;
        const glm::vec3 cross = glm::cross(b - a, c - a);
        const float area = glm::length(cross);
        if (area > 0) {
            const glm::vec3 normal = cross / area;
            sums[a] += normal * angle_at(a, b, c);
            sums[b] += normal * angle_at(b, c, a);
            sums[c] += normal * angle_at(c, a, b);
        }
    });
    for (Vertex& vertex : mesh.vertices) {
        const glm::vec3 sum = sums[vertex.position_mm];
        const float length = glm::length(sum);
        vertex.normal = length > 0 ? sum / length : glm::vec3(0, 0, 1);
    }
}

void compute_tangents(Mesh& mesh) {
    // Solve each triangle's edges for the directions of +u and +v and sum them at its corners.
    std::vector<glm::vec3> along_u(mesh.vertices.size(), glm::vec3(0));
    std::vector<glm::vec3> along_v(mesh.vertices.size(), glm::vec3(0));
    each_triangle(mesh, [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const Vertex& a = mesh.vertices[i];
        const Vertex& b = mesh.vertices[j];
        const Vertex& c = mesh.vertices[k];
        const glm::vec3 p = b.position_mm - a.position_mm;
        const glm::vec3 q = c.position_mm - a.position_mm;
        const glm::vec2 s = b.uv - a.uv;
        const glm::vec2 t = c.uv - a.uv;
        const float determinant = s.x * t.y - t.x * s.y;
        if (determinant == 0) {
            return;
        }
        const float sign = determinant > 0 ? 1.0f : -1.0f; // the length weights large triangles, as it should
        const glm::vec3 u = (p * t.y - q * s.y) * sign;
        const glm::vec3 v = (q * s.x - p * t.x) * sign;
        for (const std::uint32_t corner : {i, j, k}) {
            along_u[corner] += u;
            along_v[corner] += v;
        }
    });
    // Make the sums orthogonal to the normals and note the handedness.
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        Vertex& vertex = mesh.vertices[i];
        const glm::vec3 flat = along_u[i] - vertex.normal * glm::dot(vertex.normal, along_u[i]);
        const float length = glm::length(flat);
        const glm::vec3 tangent = length > 1e-20f ? flat / length : orthogonal(vertex.normal);
        const float handedness = glm::dot(glm::cross(vertex.normal, tangent), along_v[i]) > 0 ? -1.0f : 1.0f;
        vertex.tangent = glm::vec4(tangent, handedness);
    }
}

void mend_directions(Mesh& mesh) {
    const auto points = [](const glm::vec3& v) { return glm::dot(v, v) > 1e-12f; }; // false for NaN
    const auto all_point = [&](auto member) {
        return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                           [&](const Vertex& vertex) { return points(glm::vec3(vertex.*member)); });
    };
    if (!all_point(&Vertex::normal)) {
        Mesh computed = mesh;
        compute_normals(computed);
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            if (!points(mesh.vertices[i].normal)) {
                mesh.vertices[i].normal = computed.vertices[i].normal;
            }
        }
    }
    if (!all_point(&Vertex::tangent)) {
        Mesh computed = mesh;
        compute_tangents(computed);
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            if (!points(glm::vec3(mesh.vertices[i].tangent))) {
                mesh.vertices[i].tangent = computed.vertices[i].tangent;
            }
        }
    }
}

} // namespace renderer::scene
