// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include <renderer/scene/model.h>

namespace scene = renderer::scene;

namespace {

/// A sphere of an octahedron split `levels` times, with exact normals, each triangle with vertices of its
/// own.
scene::Mesh sphere(float radius_mm, int levels) {
    const glm::vec3 x(1, 0, 0);
    const glm::vec3 y(0, 1, 0);
    const glm::vec3 z(0, 0, 1);
    std::vector<std::array<glm::vec3, 3>> faces{{x, y, z},  {y, -x, z},  {-x, -y, z},  {-y, x, z},
                                                {y, x, -z}, {-x, y, -z}, {-y, -x, -z}, {x, -y, -z}};
    for (int level = 0; level < levels; ++level) {
        std::vector<std::array<glm::vec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const glm::vec3 ab = glm::normalize(a + b);
            const glm::vec3 bc = glm::normalize(b + c);
            const glm::vec3 ca = glm::normalize(c + a);
            for (const std::array<glm::vec3, 3>& face : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                                         std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
                finer.push_back(face);
            }
        }
        faces = finer;
    }
    scene::Mesh mesh;
    for (const auto& face : faces) {
        for (const glm::vec3& n : face) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            mesh.vertices.push_back({radius_mm * n, n, {1, 0, 0, 1}, {n.x, n.y}});
        }
    }
    return mesh;
}

float worst_radius_error(const scene::Mesh& mesh, float radius_mm) {
    float worst = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 middle =
            (mesh.vertices[mesh.indices[i]].position_mm + mesh.vertices[mesh.indices[i + 1]].position_mm +
             mesh.vertices[mesh.indices[i + 2]].position_mm) /
            3.0f;
        worst = std::max(worst, std::abs(glm::length(middle) - radius_mm));
    }
    return worst;
}

using Place = std::tuple<float, float, float>;
Place place(const glm::vec3& p) { return {p.x, p.y, p.z}; }

/// Every directed edge between places has its opposite: there is no crack.
bool watertight(const scene::Mesh& mesh) {
    std::map<std::pair<Place, Place>, int> edges;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        for (std::size_t j = 0; j < 3; ++j) {
            const Place a = place(mesh.vertices[mesh.indices[i + j]].position_mm);
            const Place b = place(mesh.vertices[mesh.indices[i + (j + 1) % 3]].position_mm);
            ++edges[{a, b}];
            --edges[{b, a}];
        }
    }
    return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

} // namespace

TEST(GeometryTest, normalsOfASpherePointOutward) {
    scene::Mesh mesh = sphere(50, 3);
    for (scene::Vertex& vertex : mesh.vertices) {
        vertex.normal = glm::vec3(0);
    }
    scene::compute_normals(mesh);
    for (const scene::Vertex& vertex : mesh.vertices) {
        // The mesh is not quite symmetric about each vertex: 3 degrees are allowed.
        EXPECT_GT(glm::dot(vertex.normal, glm::normalize(vertex.position_mm)), std::cos(0.052f));
    }
}

TEST(GeometryTest, tangentsFollowU) {
    scene::Mesh mesh;
    // A quad in the xy plane whose u runs along -y and whose v runs along +x.
    mesh.vertices = {{{0, 0, 0}, {0, 0, 1}, {}, {0, 0}},
                     {{1, 0, 0}, {0, 0, 1}, {}, {0, 1}},
                     {{1, -1, 0}, {0, 0, 1}, {}, {1, 1}},
                     {{0, -1, 0}, {0, 0, 1}, {}, {1, 0}}};
    mesh.indices = {0, 2, 1, 0, 3, 2};
    scene::compute_tangents(mesh);
    for (const scene::Vertex& vertex : mesh.vertices) {
        EXPECT_NEAR(vertex.tangent.y, -1, 1e-6f);
        const glm::vec3 bitangent = glm::cross(vertex.normal, glm::vec3(vertex.tangent)) * vertex.tangent.w;
        EXPECT_NEAR(bitangent.x, -1, 1e-6f); // up the image, against v
    }
}

TEST(RefineTest, bringsACoarseSphereCloserToRound) {
    scene::Mesh mesh = sphere(50, 2);
    const float before = worst_radius_error(mesh, 50);
    const std::size_t triangles = mesh.indices.size();
    scene::refine(mesh, 6);
    EXPECT_EQ(mesh.indices.size(), 64 * triangles); // edges of 27 mm, halved until they are at most 6 mm
    // Flat splitting would leave the error as it is; a PN triangle of this sphere is within 1 % of its sag.
    EXPECT_LT(worst_radius_error(mesh, 50), 0.15f * before);
}

TEST(RefineTest, leavesNoCracksBetweenVerticesAtOnePlace) {
    scene::Mesh mesh = sphere(50, 1);
    ASSERT_TRUE(watertight(mesh));
    scene::refine(mesh, 15);
    EXPECT_TRUE(watertight(mesh));
}

TEST(RefineTest, keepsFlatSurfacesFlatAndCreasesSharp) {
    // Two quads that meet at a right angle along x = 0.
    scene::Mesh mesh;
    mesh.vertices = {
        {{0, 0, 0}, {0, 0, 1}, {1, 0, 0, 1}, {}},     {{10, 0, 0}, {0, 0, 1}, {1, 0, 0, 1}, {}},
        {{10, 10, 0}, {0, 0, 1}, {1, 0, 0, 1}, {}},   {{0, 10, 0}, {0, 0, 1}, {1, 0, 0, 1}, {}},
        {{0, 0, 0}, {-1, 0, 0}, {0, 0, 1, 1}, {}},    {{0, 10, 0}, {-1, 0, 0}, {0, 0, 1, 1}, {}},
        {{0, 10, -10}, {-1, 0, 0}, {0, 0, 1, 1}, {}}, {{0, 0, -10}, {-1, 0, 0}, {0, 0, 1, 1}, {}}};
    mesh.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    scene::refine(mesh, 3);
    EXPECT_GT(mesh.indices.size(), 12u);
    for (const scene::Vertex& vertex : mesh.vertices) {
        EXPECT_TRUE(vertex.position_mm.z == 0 || vertex.position_mm.x == 0);
    }
}

TEST(RefineTest, doesNothingToAFineMesh) {
    scene::Mesh mesh = sphere(50, 2);
    const std::size_t triangles = mesh.indices.size();
    scene::refine(mesh, 1000);
    EXPECT_EQ(mesh.indices.size(), triangles);
}
