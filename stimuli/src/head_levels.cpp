// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/head.h>

#include <meshoptimizer.h>

#include "head_crossing.h"

namespace stimuli {

using renderer::scene::Mesh;
using renderer::scene::Model;
using renderer::scene::Vertex;

namespace {

/// Corners of the triangles that are left when edges collapse until no more than `triangles` are; `stretch`
/// is how tall the head is taken to be where errors are compared.
std::vector<std::uint32_t> collapsed(const Mesh& mesh, std::size_t triangles, float stretch) {
    std::vector<glm::vec3> places;
    for (const Vertex& vertex : mesh.vertices) {
        places.push_back(vertex.position_mm * glm::vec3(1, stretch, 1));
    }
    std::vector<std::uint32_t> kept(mesh.indices.size());
    constexpr float any_error = 1; // of the head's size
    kept.resize(meshopt_simplify(kept.data(), mesh.indices.data(), mesh.indices.size(), &places[0].x,
                                 places.size(), sizeof(glm::vec3), 3 * triangles, any_error));
    return kept;
}

} // namespace

Model simplified(const Model& head, HeadDetail detail) {
    if (detail == HeadDetail::full) {
        return head;
    }
    // Edges collapse onto vertices that are there already [GarlandHeckbert1997]; both sides of the seam move
    // as one.
    Model result = head;
    Mesh& mesh = result.meshes.front();
    const std::size_t wanted = mesh.indices.size() / 3 / (detail == HeadDetail::fifth ? 5 : 10);
    // Collapsing may push thin parts through each other; for slightly other proportions other edges collapse.
    constexpr int tries = 30;
    std::vector<std::uint32_t> kept = collapsed(mesh, wanted, 1);
    Mesh tried = mesh;
    for (int k = 1; k <= tries && (tried.indices = kept, head::crossing(tried)); ++k) {
        kept = collapsed(mesh, wanted, 1 + 0.02F * static_cast<float>(k));
    }
    std::vector<Vertex> vertices(mesh.vertices.size());
    vertices.resize(meshopt_optimizeVertexFetch(vertices.data(), kept.data(), kept.size(),
                                                mesh.vertices.data(), mesh.vertices.size(), sizeof(Vertex)));
    mesh.vertices = std::move(vertices);
    mesh.indices = std::move(kept);
    result.digest = renderer::scene::content_digest(result);
    return result;
}

} // namespace stimuli
