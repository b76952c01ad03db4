// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace renderer::scene {

/// 8-bit pixels, rows from the top (v = 0) down.
struct Image {
    int width = 0, height = 0;
    int channels = 0; ///< 3 or 4
    std::vector<std::uint8_t> pixels;
};
using ImagePtr = std::shared_ptr<const Image>;

/// glTF's metallic-roughness material, less what skin does not need.
struct Material {
    std::string name;
    ImagePtr base_color;            ///< sRGB; null: white
    ImagePtr normal;                ///< tangent space, green up the image as in glTF; null: flat
    ImagePtr roughness;             ///< green channel; null: 1
    ImagePtr specular;              ///< strength of the reflection, alpha channel; null: 1
    glm::vec3 base_color_factor{1}; ///< linear Rec. 709
    float normal_scale = 1;
    float roughness_factor = -1; ///< glTF's perceptual roughness in [0, 1]; negative: the file says nothing
    float specular_factor = 1;   ///< multiplies the look's specular intensity, in [0, 1]
    bool double_sided = false;
    bool scatters = true; ///< light enters and leaves again elsewhere; else it is reflected where it falls
};

struct Vertex {
    glm::vec3 position_mm{0};
    glm::vec3 normal{0}; ///< unit length
    glm::vec4 tangent{
        0};          ///< unit length along +u; cross(normal, tangent) * w runs up the image (-v), as in glTF
    glm::vec2 uv{0}; ///< (0, 0) is the first texel of the first image row, as in glTF
};

/// Triangles of one material, counter-clockwise seen from outside.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices; ///< three a triangle
    std::size_t material = 0;
    bool has_uv = false;
};

/// A model in millimetres, right-handed, +Y up, the face looking along +Z.
struct Model {
    std::string name;
    std::string digest; ///< SHA-256 of everything that it was read from
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
};

/// SHA-256 of all that makes the model's picture: vertices, indices, materials, pixels.
std::string content_digest(const Model& model);

/// Axis-aligned bounds, millimetres.
struct Bounds {
    glm::vec3 low{0}, high{0};
};

/// Bounds of all vertices that triangles use. The model holds at least one triangle.
Bounds bounds(const Model& model);
/// The same, of the part at or above `floor_mm`.
Bounds bounds_above(const Model& model, float floor_mm);

/// Angle-weighted vertex normals [ThuermerWuethrich1998], smooth across vertices at the same place.
void compute_normals(Mesh& mesh);
/// Tangents along +u, orthogonal to the normals; any orthogonal direction where the UVs are degenerate.
void compute_tangents(Mesh& mesh);

/// Replace normals and tangents that have no direction, as files in the wild have, by computed ones.
void mend_directions(Mesh& mesh);

/// Round off the facets of a coarse mesh: split each triangle into four until the mean edge is at most
/// `longest_edge_mm`. New vertices lie on the curved PN triangles [Vlachos2001], so that the
/// surface goes through the old vertices with their normals, without cracks; creases (normals that differ at
/// one place by more than 30 degrees) stay sharp. Stops before it makes more than 2 million triangles.
void refine(Mesh& mesh, float longest_edge_mm);

} // namespace renderer::scene
