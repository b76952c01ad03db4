// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/head.h>

#include <meshoptimizer.h>

namespace stimuli {

using renderer::scene::Mesh;
using renderer::scene::Model;
using renderer::scene::Vertex;

Model simplified(const Model& head, HeadDetail detail) {
    if (detail == HeadDetail::full) {
        return head;
    }
    // Edges collapse onto vertices that are there already [GarlandHeckbert1997]; both sides of the seam move
    // as one.
    Model result = head;
    Mesh& mesh = result.meshes.front();
    const std::size_t wanted = mesh.indices.size() / 3 / (detail == HeadDetail::fifth ? 5 : 10) * 3;
    std::vector<std::uint32_t> kept(mesh.indices.size());
    constexpr float any_error = 1; // of the head's size
    kept.resize(meshopt_simplify(kept.data(), mesh.indices.data(), mesh.indices.size(),
                                 &mesh.vertices[0].position_mm.x, mesh.vertices.size(), sizeof(Vertex),
                                 wanted, any_error));
    std::vector<Vertex> vertices(mesh.vertices.size());
    vertices.resize(meshopt_optimizeVertexFetch(vertices.data(), kept.data(), kept.size(),
                                                mesh.vertices.data(), mesh.vertices.size(), sizeof(Vertex)));
    mesh.vertices = std::move(vertices);
    mesh.indices = std::move(kept);
    result.digest = renderer::scene::content_digest(result);
    return result;
}

} // namespace stimuli
