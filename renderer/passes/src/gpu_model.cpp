// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "gpu_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace renderer::passes {
namespace {

// Mipmaps alone blur what is seen from the side: against 16 rays a pixel, this takes a quarter off FLIP at
// the study's farthest distance.
constexpr float widest_anisotropy = 8;

void sharpen(const gl::Texture& texture) {
    if (epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") ||
        epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic")) {
        GLfloat most = 1;
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &most);
        glTextureParameterf(texture.id(), GL_TEXTURE_MAX_ANISOTROPY, std::min(widest_anisotropy, most));
    }
}

gl::Texture uploaded(const scene::ImagePtr& image, bool srgb, const scene::Image& fallback) {
    const scene::Image& source = image ? *image : fallback;
    const int levels = std::bit_width(static_cast<unsigned>(std::max(source.width, source.height)));
    gl::Texture texture(srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, source.width, source.height, levels);
    texture.upload(source.channels == 4 ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE, source.pixels.data());
    texture.generate_mipmaps();
    texture.filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
    sharpen(texture);
    return texture;
}

/// A place relative to an origin.
glm::vec3 relative(const glm::vec3& place_mm, const glm::dvec3& origin_mm) {
    return glm::vec3(glm::dvec3(place_mm) - origin_mm);
}

GpuModel::Mesh uploaded(const scene::Mesh& mesh) {
    GpuModel::Mesh result;
    result.vertices = gl::Buffer(mesh.vertices.data(), mesh.vertices.size() * sizeof(scene::Vertex));
    result.indices = gl::Buffer(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
    result.index_count = static_cast<GLsizei>(mesh.indices.size());
    result.material = mesh.material;
    const GLuint array = result.array.id();
    glVertexArrayVertexBuffer(array, 0, result.vertices.id(), 0, sizeof(scene::Vertex));
    glVertexArrayElementBuffer(array, result.indices.id());
    // The locations are those of vertex_inputs.glsl.
    struct Attribute {
        GLint size;
        std::size_t offset;
    };
    const Attribute attributes[] = {{3, offsetof(scene::Vertex, position_mm)},
                                    {3, offsetof(scene::Vertex, normal)},
                                    {4, offsetof(scene::Vertex, tangent)},
                                    {2, offsetof(scene::Vertex, uv)}};
    for (GLuint location = 0; location < std::size(attributes); ++location) {
        glEnableVertexArrayAttrib(array, location);
        glVertexArrayAttribBinding(array, location, 0);
        glVertexArrayAttribFormat(array, location, attributes[location].size, GL_FLOAT, GL_FALSE,
                                  static_cast<GLuint>(attributes[location].offset));
    }
    return result;
}

} // namespace

GpuModel::GpuModel(const scene::Model& model, float default_slope) {
    const scene::Bounds world = scene::bounds(model);
    origin_mm_ = 0.5 * (glm::dvec3(world.low) + glm::dvec3(world.high));
    bounds_ = {relative(world.low, origin_mm_), relative(world.high, origin_mm_)};
    const scene::Image white{1, 1, 3, {255, 255, 255}};
    const scene::Image flat{1, 1, 3, {128, 128, 255}};
    for (const scene::Material& source : model.materials) {
        Material material;
        material.base_color = uploaded(source.base_color, true, white);
        material.normal = uploaded(source.normal, false, flat);
        material.roughness = uploaded(source.roughness, false, white);
        material.base_color_factor = source.base_color_factor;
        material.normal_scale = source.normal ? source.normal_scale : 0;
        // The shader squares glTF's perceptual roughness into the slope.
        material.roughness_factor =
            source.roughness_factor < 0 ? std::sqrt(default_slope) : source.roughness_factor;
        material.double_sided = source.double_sided;
        materials_.push_back(std::move(material));
    }
    for (scene::Mesh mesh : model.meshes) {
        for (scene::Vertex& vertex : mesh.vertices) {
            vertex.position_mm = relative(vertex.position_mm, origin_mm_);
        }
        scene::mend_directions(mesh);
        std::vector<bool> used(mesh.vertices.size());
        for (const std::uint32_t index : mesh.indices) {
            if (!used[index]) {
                used[index] = true;
                places_mm_.push_back(mesh.vertices[index].position_mm);
            }
        }
        meshes_.push_back(uploaded(mesh));
    }
}

float GpuModel::extent_mm() const {
    const glm::vec3 sides = bounds_.high - bounds_.low;
    return std::max({sides.x, sides.y, sides.z, 1e-6f}); // a nanometre, for a model without an extent
}

scene::Camera GpuModel::seen_by(scene::Camera camera) const {
    camera.eye_mm = relative(camera.eye_mm, origin_mm_);
    camera.target_mm = relative(camera.target_mm, origin_mm_);
    return camera;
}

void GpuModel::bind_material(const gl::Program& program, std::size_t index, bool may_be_double_sided) const {
    const Material& material = materials_[index];
    material.base_color.bind(0);
    material.normal.bind(1);
    material.roughness.bind(2);
    program.set("base_color_factor", material.base_color_factor);
    program.set("normal_scale", material.normal_scale);
    program.set("roughness_factor", material.roughness_factor);
    const bool double_sided = material.double_sided && may_be_double_sided;
    program.set("double_sided", double_sided ? 1 : 0);
    if (double_sided || !may_be_double_sided) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
    }
}

void GpuModel::draw_mesh(const Mesh& mesh) {
    glBindVertexArray(mesh.array.id());
    glDrawElements(GL_TRIANGLES, mesh.index_count, GL_UNSIGNED_INT, nullptr);
}

void GpuModel::draw(const gl::Program& program) const {
    for (const Mesh& mesh : meshes_) {
        bind_material(program, mesh.material, true);
        draw_mesh(mesh);
    }
    glDisable(GL_CULL_FACE);
}

void GpuModel::draw_places() const {
    glDisable(GL_CULL_FACE);
    for (const Mesh& mesh : meshes_) {
        draw_mesh(mesh);
    }
}

} // namespace renderer::passes
