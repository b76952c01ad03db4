// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "gpu_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

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
    return texture;
}

/// A place relative to an origin.
glm::vec3 relative(const glm::vec3& place_mm, const glm::dvec3& origin_mm) {
    return glm::vec3(glm::dvec3(place_mm) - origin_mm);
}

/// Textures of images, each uploaded once.
class Textures {
public:
    std::shared_ptr<const gl::Texture> of(const scene::ImagePtr& image, bool srgb, bool sharp,
                                          const scene::Image& fallback) {
        std::shared_ptr<const gl::Texture>& texture = textures_[{image ? image.get() : &fallback, srgb}];
        if (!texture) {
            texture = std::make_shared<gl::Texture>(uploaded(image, srgb, fallback));
            if (sharp) {
                sharpen(*texture);
            }
        }
        return texture;
    }

private:
    std::map<std::pair<const scene::Image*, bool>, std::shared_ptr<const gl::Texture>> textures_;
};

GpuModel::Mesh uploaded(const scene::Mesh& mesh) {
    GpuModel::Mesh result;
    result.vertices = gl::Buffer(mesh.vertices.data(), mesh.vertices.size() * sizeof(scene::Vertex));
    result.indices = gl::Buffer(mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
    result.index_count = static_cast<GLsizei>(mesh.indices.size());
    result.material = mesh.material;
    result.clusters = clusters_of(mesh);
    for (const Cluster& cluster : result.clusters) {
        const bool first = &cluster == result.clusters.data();
        result.box.low = first ? cluster.box.low : glm::min(result.box.low, cluster.box.low);
        result.box.high = first ? cluster.box.high : glm::max(result.box.high, cluster.box.high);
    }
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

/// Add a cluster to what is drawn; it follows the one added before it, or not.
void add_run(GpuModel::Part& part, const Cluster& cluster) {
    const auto offset = [](std::size_t index) {
        return reinterpret_cast<const void*>(index * sizeof(std::uint32_t));
    };
    const bool follows =
        !part.counts.empty() && reinterpret_cast<std::size_t>(part.offsets.back()) / sizeof(std::uint32_t) +
                                        static_cast<std::size_t>(part.counts.back()) ==
                                    cluster.first;
    if (follows) {
        part.counts.back() += static_cast<GLsizei>(cluster.count);
    } else {
        part.offsets.push_back(offset(cluster.first));
        part.counts.push_back(static_cast<GLsizei>(cluster.count));
    }
}

} // namespace

GpuModel::GpuModel(const scene::Model& model, float default_slope) {
    const scene::Bounds world = scene::bounds(model);
    origin_mm_ = 0.5 * (glm::dvec3(world.low) + glm::dvec3(world.high));
    bounds_ = {relative(world.low, origin_mm_), relative(world.high, origin_mm_)};
    const scene::Image white{1, 1, 3, {255, 255, 255}};
    const scene::Image flat{1, 1, 3, {128, 128, 255}};
    Textures textures;
    for (const scene::Material& source : model.materials) {
        Material material;
        material.base_color = textures.of(source.base_color, true, true, white);
        material.normal = textures.of(source.normal, false, true, flat);
        material.roughness = textures.of(source.roughness, false, false, white);
        material.specular = textures.of(source.specular, false, false, white);
        material.traits = {source.base_color != nullptr, source.normal && source.normal_scale != 0,
                           source.roughness != nullptr, source.specular != nullptr, source.scatters};
        material.base_color_factor = source.base_color_factor;
        material.normal_scale = source.normal ? source.normal_scale : 0;
        // The shader squares glTF's perceptual roughness into the slope.
        material.roughness_factor =
            source.roughness_factor < 0 ? std::sqrt(default_slope) : source.roughness_factor;
        material.specular_factor = source.specular_factor;
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
    material.base_color->bind(0);
    material.normal->bind(1);
    material.roughness->bind(2);
    material.specular->bind(7);
    program.set("base_color_factor", material.base_color_factor);
    program.set("normal_scale", material.normal_scale);
    program.set("roughness_factor", material.roughness_factor);
    program.set("specular_factor", material.specular_factor);
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

GpuModel::Traits GpuModel::traits(std::size_t material) const { return materials_[material].traits; }

bool GpuModel::has_skin() const {
    return std::any_of(meshes_.begin(), meshes_.end(),
                       [&](const Mesh& mesh) { return materials_[mesh.material].traits.scatters; });
}

GpuModel::View GpuModel::view(const scene::Camera& camera, const Switches& switches) const {
    const Frustum frustum(camera);
    View view;
    glm::vec2 depths_mm(std::numeric_limits<float>::infinity(), 0);
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        const Mesh& mesh = meshes_[i];
        const Material& material = materials_[mesh.material];
        Part part;
        part.mesh = i;
        part.nearest_mm = std::numeric_limits<float>::infinity();
        if (switches.cull && !frustum.may_see(mesh.box)) {
            view.triangles += mesh.index_count / 3;
            view.culled += mesh.index_count / 3;
            continue;
        }
        for (const Cluster& cluster : mesh.clusters) {
            const bool visible = frustum.may_see(cluster.box) &&
                                 (material.double_sided || !turned_away(cluster, frustum.eye_mm()));
            view.triangles += cluster.count / 3;
            if (visible) {
                const PixelRect rect = frustum.rect(cluster.box);
                view.rect = united(view.rect, rect);
                const glm::vec2 cluster_mm = frustum.depths_mm(cluster.box);
                part.nearest_mm = std::min(part.nearest_mm, cluster_mm.x);
                part.clusters.push_back(&cluster);
                if (material.traits.scatters) {
                    view.skin = united(view.skin, rect);
                    depths_mm = {std::min(depths_mm.x, cluster_mm.x), std::max(depths_mm.y, cluster_mm.y)};
                }
            } else {
                view.culled += cluster.count / 3;
            }
            if (visible || !switches.cull) {
                add_run(part, cluster);
            }
        }
        if (!part.clusters.empty() || !switches.cull) {
            view.parts.push_back(std::move(part));
        }
    }
    // Where the camera is beside or inside the skin, this share of the model's size is near enough.
    constexpr float share_in_front = 1e-3f;
    view.nearest_mm = std::max(std::min(depths_mm.x, depths_mm.y), share_in_front * extent_mm());
    view.farthest_mm = std::max(depths_mm.y, view.nearest_mm);
    if (switches.front_to_back) {
        std::stable_sort(view.parts.begin(), view.parts.end(),
                         [](const Part& a, const Part& b) { return a.nearest_mm < b.nearest_mm; });
    }
    if (!switches.rectangle) {
        view.rect = view.skin = {0, 0, camera.width, camera.height};
    }
    return view;
}

bool GpuModel::may_light(const View& view, const glm::vec3& direction) const {
    return std::any_of(view.parts.begin(), view.parts.end(), [&](const Part& part) {
        return materials_[meshes_[part.mesh].material].double_sided ||
               std::any_of(part.clusters.begin(), part.clusters.end(),
                           [&](const Cluster* cluster) { return passes::may_light(*cluster, direction); });
    });
}

void GpuModel::draw_part(const Part& part) const {
    glBindVertexArray(meshes_[part.mesh].array.id());
    glMultiDrawElements(GL_TRIANGLES, part.counts.data(), GL_UNSIGNED_INT, part.offsets.data(),
                        static_cast<GLsizei>(part.counts.size()));
}

void GpuModel::draw_places() const {
    glDisable(GL_CULL_FACE);
    for (const Mesh& mesh : meshes_) {
        draw_mesh(mesh);
    }
}

} // namespace renderer::passes
