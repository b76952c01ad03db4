// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <cstring>
#include <unordered_map>

#include <renderer/scene/model.h>

#include "place.h"

namespace renderer::scene {
namespace {

constexpr std::size_t most_triangles = 2'000'000;
constexpr float crease_cos = 0.866f; // 30 degrees

float mean_edge_mm(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        for (std::size_t j = 0; j < 3; ++j) {
            const glm::vec3& a = mesh.vertices[mesh.indices[i + j]].position_mm;
            const glm::vec3& b = mesh.vertices[mesh.indices[i + (j + 1) % 3]].position_mm;
            sum += static_cast<double>(glm::length(b - a));
        }
    }
    return mesh.indices.empty() ? 0.0f : static_cast<float>(sum / static_cast<double>(mesh.indices.size()));
}

/// One normal for each place, whatever the vertices there say apart: zero on a crease.
std::unordered_map<glm::vec3, glm::vec3, PlaceHash> common_normals(const Mesh& mesh) {
    std::unordered_map<glm::vec3, glm::vec3, PlaceHash> normals;
    for (const Vertex& vertex : mesh.vertices) {
        normals[vertex.position_mm] += vertex.normal;
    }
    for (auto& [place, normal] : normals) {
        const float length = glm::length(normal);
        normal = length > 0 ? normal / length : glm::vec3(0);
    }
    for (const Vertex& vertex : mesh.vertices) {
        glm::vec3& normal = normals[vertex.position_mm];
        if (glm::dot(normal, vertex.normal) < crease_cos) {
            normal = glm::vec3(0);
        }
    }
    return normals;
}

/// The middle of the cubic edge of a PN triangle: (a + b) / 2 - (w_ab n_a + w_ba n_b) / 8, w_ab = (b - a) .
/// n_a. It depends on the edge's ends alone, so both triangles at an edge agree.
glm::vec3 curved_middle(const glm::vec3& a, const glm::vec3& n_a, const glm::vec3& b, const glm::vec3& n_b) {
    return 0.5f * (a + b) - 0.125f * (glm::dot(b - a, n_a) * n_a + glm::dot(a - b, n_b) * n_b);
}

Vertex middle(const Vertex& a, const glm::vec3& n_a, const Vertex& b, const glm::vec3& n_b) {
    Vertex vertex;
    vertex.position_mm = curved_middle(a.position_mm, n_a, b.position_mm, n_b);
    const glm::vec3 normal = a.normal + b.normal;
    vertex.normal = glm::dot(normal, normal) > 1e-12f ? glm::normalize(normal) : a.normal;
    vertex.uv = 0.5f * (a.uv + b.uv);
    const glm::vec3 t(a.tangent + b.tangent);
    const glm::vec3 flat = t - vertex.normal * glm::dot(vertex.normal, t);
    vertex.tangent = glm::dot(flat, flat) > 1e-12f ? glm::vec4(glm::normalize(flat), a.tangent.w) : a.tangent;
    return vertex;
}

Mesh split(const Mesh& mesh) {
    const auto normals = common_normals(mesh);
    Mesh result;
    result.vertices = mesh.vertices;
    result.material = mesh.material;
    result.has_uv = mesh.has_uv;
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    const auto middle_of = [&](std::uint32_t i, std::uint32_t j) {
        const std::uint32_t first = std::min(i, j);
        const std::uint32_t last = std::max(i, j);
        const auto next = static_cast<std::uint32_t>(result.vertices.size());
        const auto [found, added] = middles.emplace(std::uint64_t{first} << 32 | last, next);
        if (added) {
            // The order of the ends must not depend on the triangle, nor on which copy of a vertex it uses.
            const Vertex& a = mesh.vertices[first];
            const Vertex& b = mesh.vertices[last];
            const bool swapped = std::memcmp(&a.position_mm, &b.position_mm, sizeof a.position_mm) > 0;
            const Vertex& p = swapped ? b : a;
            const Vertex& q = swapped ? a : b;
            result.vertices.push_back(middle(p, normals.at(p.position_mm), q, normals.at(q.position_mm)));
        }
        return found->second;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i];
        const std::uint32_t b = mesh.indices[i + 1];
        const std::uint32_t c = mesh.indices[i + 2];
        const std::uint32_t ab = middle_of(a, b);
        const std::uint32_t bc = middle_of(b, c);
        const std::uint32_t ca = middle_of(c, a);
        result.indices.insert(result.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    return result;
}

} // namespace

void refine(Mesh& mesh, float longest_edge_mm) {
    while (mean_edge_mm(mesh) > longest_edge_mm && mesh.indices.size() / 3 * 4 <= most_triangles) {
        mesh = split(mesh);
    }
}

} // namespace renderer::scene
