// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "models.h"

#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace stability {

namespace scene = renderer::scene;
using support::Generator;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A mesh over a grid of (columns + 1) x (rows + 1) vertices, counter-clockwise where u runs right and v
/// down.
template <typename VertexAt>
scene::Mesh grid(int columns, int rows, const VertexAt& vertex_at) {
    scene::Mesh mesh;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            mesh.vertices.push_back(vertex_at(static_cast<float>(i) / static_cast<float>(columns),
                                              static_cast<float>(j) / static_cast<float>(rows)));
        }
    }
    const auto index = [columns](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const std::uint32_t a = index(i, j);
            const std::uint32_t b = index(i, j + 1);
            const std::uint32_t c = index(i + 1, j + 1);
            const std::uint32_t d = index(i + 1, j);
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    }
    mesh.has_uv = true;
    return mesh;
}

scene::Model of_mesh(scene::Mesh mesh, const char* name) {
    scene::Model model;
    model.name = name;
    model.materials.emplace_back();
    model.meshes.push_back(std::move(mesh));
    return model;
}

scene::Mesh square_mesh(float side_mm, float z_mm, int cells) {
    return grid(cells, cells, [&](float u, float v) {
        return scene::Vertex{
            {side_mm * (u - 0.5f), side_mm * (0.5f - v), z_mm}, {0, 0, 1}, {1, 0, 0, 1}, {u, v}};
    });
}

glm::vec3 random_place(float side_mm, Generator& random) {
    glm::vec3 place;
    for (int i = 0; i < 3; ++i) {
        place[i] = side_mm * static_cast<float>(random.uniform() - 0.5);
    }
    return place;
}

} // namespace

scene::Model square(float side_mm, int cells) { return of_mesh(square_mesh(side_mm, 0, cells), "square"); }

scene::Model dented_sphere(float radius_mm, float dent, int columns, int rows) {
    scene::Mesh mesh = grid(columns, rows, [&](float u, float v) {
        const glm::vec3 n(-std::sin(2 * pi * u) * std::sin(pi * v), std::cos(pi * v),
                          -std::cos(2 * pi * u) * std::sin(pi * v));
        const float wave = std::sin(5 * n.x + 1) * std::sin(6 * n.y) * std::sin(4 * n.z + 2);
        return scene::Vertex{n * radius_mm * (1 + dent * wave), n, {}, {u, v}};
    });
    if (dent > 0) {
        scene::compute_normals(mesh);
    }
    scene::compute_tangents(mesh);
    return of_mesh(std::move(mesh), "sphere");
}

scene::Model step(float side_mm, float gap_mm) {
    scene::Model model = of_mesh(square_mesh(side_mm, 0, 2), "step");
    model.meshes.push_back(square_mesh(0.4f * side_mm, gap_mm, 2));
    const float roll_rad = 0.3f;
    const glm::mat3 roll(glm::rotate(glm::mat4(1), roll_rad, glm::vec3(0, 0, 1)));
    for (std::size_t i = 0; i < 2; ++i) {
        for (scene::Vertex& vertex : model.meshes[i].vertices) {
            vertex.position_mm = roll * vertex.position_mm;
            vertex.tangent = glm::vec4(roll * glm::vec3(vertex.tangent), vertex.tangent.w);
            vertex.uv.x = 0.45f * vertex.uv.x + (i == 0 ? 0.0f : 0.55f); // half of the texture each
        }
    }
    return model;
}

scene::Model soup(float side_mm, int triangles, Generator& random) {
    scene::Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const glm::vec3 middle = random_place(side_mm, random);
        const glm::vec3 first = middle + random_place(0.5f * side_mm, random);
        const bool flat = random.below(8) == 0;
        const std::array<glm::vec3, 3> corners{middle, first,
                                               flat ? first : middle + random_place(0.5f * side_mm, random)};
        for (const glm::vec3& corner : corners) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
            const glm::vec2 uv(static_cast<float>(random.uniform()), static_cast<float>(random.uniform()));
            mesh.vertices.push_back({corner, {}, {}, uv});
        }
    }
    mesh.has_uv = true;
    scene::compute_normals(mesh);
    scene::compute_tangents(mesh);
    return of_mesh(std::move(mesh), "soup");
}

scene::ImagePtr noise_image(int width, int height, Generator& random) {
    auto image = std::make_shared<scene::Image>(scene::Image{width, height, 3, {}});
    for (int i = 0; i < 3 * width * height; ++i) {
        image->pixels.push_back(static_cast<std::uint8_t>(random.below(256)));
    }
    return image;
}

const char* name(Damage damage) {
    constexpr std::array<const char*, damages> names{
        "none",          "zero normals", "opposite normals", "zero tangents", "degenerate triangles",
        "collapsed UVs", "one UV",       "far UVs",          "missing UVs"};
    return names[static_cast<std::size_t>(damage)];
}

void spoil(scene::Model& model, Damage damage, Generator& random) {
    for (scene::Mesh& mesh : model.meshes) {
        for (scene::Vertex& vertex : mesh.vertices) {
            const bool hit = random.below(4) == 0;
            if (damage == Damage::zero_normals && hit) {
                vertex.normal = glm::vec3(0);
            } else if (damage == Damage::opposite_normals && hit) {
                vertex.normal = -vertex.normal;
            } else if (damage == Damage::zero_tangents) {
                vertex.tangent = glm::vec4(0, 0, 0, 1);
            } else if (damage == Damage::one_uv) {
                vertex.uv = {0.5f, 0.5f};
            } else if (damage == Damage::far_uvs) {
                vertex.uv = vertex.uv * 1e6f + 3e6f;
            }
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const bool hit = random.below(4) == 0;
            if (damage == Damage::degenerate_triangles && hit) {
                mesh.indices[i + 2] = mesh.indices[i + random.below(2)];
            } else if (damage == Damage::collapsed_uvs && hit) {
                const glm::vec2 uv = mesh.vertices[mesh.indices[i]].uv;
                mesh.vertices[mesh.indices[i + 1]].uv = mesh.vertices[mesh.indices[i + 2]].uv = uv;
            }
        }
        mesh.has_uv = mesh.has_uv && damage != Damage::missing_uvs;
    }
}

} // namespace stability
