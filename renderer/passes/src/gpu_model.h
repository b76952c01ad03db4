// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <memory>
#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>
#include <renderer/scene/camera.h>
#include <renderer/scene/model.h>

#include "culling.h"

namespace renderer::passes {

/// A model's buffers and textures on the GPU, with the places of its vertices for fitting cameras and lights.
/// Places are relative to the middle of the model's bounds, so that floats have room for details of a model
/// far from the world's origin. Normals and tangents that are zero are made anew. Materials share their
/// images.
class GpuModel {
public:
    /// `default_slope` is Beckmann's m where a material says nothing of its roughness.
    GpuModel(const scene::Model& model, float default_slope);

    struct Mesh {
        gl::Buffer vertices, indices;
        gl::VertexArray array;
        GLsizei index_count = 0;
        std::size_t material = 0;
        scene::Bounds box; ///< of all its triangles
        std::vector<Cluster> clusters;
    };
    const std::vector<Mesh>& meshes() const { return meshes_; }

    /// What a camera may see of a mesh.
    struct Part {
        std::size_t mesh = 0;
        std::vector<const Cluster*> clusters;
        std::vector<GLsizei> counts;      ///< of runs of indices to draw
        std::vector<const void*> offsets; ///< and where they begin
        float nearest_mm = 0;
    };
    /// What a camera may see of the model.
    struct View {
        std::vector<Part> parts;               ///< in the order to draw
        PixelRect rect, skin;                  ///< nothing, and no skin, outside of these
        float nearest_mm = 1, farthest_mm = 1; ///< depths of the skin; above 0
        long long triangles = 0, culled = 0;
    };
    View view(const scene::Camera& camera, const Switches& switches) const;
    /// Whether a light from a direction may reach something in view.
    bool may_light(const View& view, const glm::vec3& direction) const;

    /// What a material has.
    struct Traits {
        bool color_map = false, normal_map = false, roughness_map = false, specular_map = false,
             scatters = true;
    };
    Traits traits(std::size_t material) const;
    /// Whether any mesh scatters light.
    bool has_skin() const;
    std::size_t material_count() const { return materials_.size(); }
    /// The vertices that triangles use.
    const std::vector<glm::vec3>& places_mm() const { return places_mm_; }
    const scene::Bounds& bounds() const { return bounds_; }
    /// The largest side of the bounds, above 0.
    float extent_mm() const;
    /// A camera of the world, relative to the model's origin.
    scene::Camera seen_by(scene::Camera camera) const;

    /// Bind a material's maps to units 0 to 2 and 7, and set its factors.
    void bind_material(const gl::Program& program, std::size_t material, bool may_be_double_sided) const;

    /// Draw all meshes with a program that reads places alone, both sides.
    void draw_places() const;
    static void draw_mesh(const Mesh& mesh);
    void draw_part(const Part& part) const;

private:
    struct Material {
        std::shared_ptr<const gl::Texture> base_color, normal, roughness, specular;
        glm::vec3 base_color_factor{1};
        float normal_scale = 1, roughness_factor = 1, specular_factor = 1;
        bool double_sided = false;
        Traits traits;
    };
    std::vector<Mesh> meshes_;
    std::vector<Material> materials_;
    std::vector<glm::vec3> places_mm_;
    glm::dvec3 origin_mm_{0}; ///< in the world
    scene::Bounds bounds_;
};

} // namespace renderer::passes
