// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"
#include "lit_frame.h"
#include "program_variants.h"
#include "shadow_map.h"
#include "uv_layout.h"
#include "uv_maps.h"

namespace renderer::passes {

/// What of texture space was lit, and what was left out.
struct TextureSpaceCounts {
    int layouts = 0;                              ///< that differ; copies share one
    int maps_lit = 0, maps_skipped = 0;           ///< skipped: nothing of them is in view
    long long texels_lit = 0, texels_skipped = 0; ///< on charts of the maps lit
    std::set<int> sizes;                          ///< of the maps lit, texels a side
};

/// Subsurface scattering in texture space [DEonLuebke2007]: a square irradiance map for each material,
/// blurred by a cascade of Gaussians whose widths follow a stretch map that is blurred along. The narrowest
/// Gaussian, finer than a texel, is left to the screen. Materials that are copies of each other share what
/// depends on the mesh alone.
class TextureSpace {
public:
    /// Unwrap the model: charts, stretch maps and their blurs depend on nothing else.
    /// Throws support::InputError if a mesh has no texture coordinates.
    TextureSpace(const scene::Model& source, const GpuModel& model, const optics::Profile& profile,
                 const Methods& methods, int width, int height, int samples);

    /// Light the maps and blur them: once a light, or, in the culled form, once a view, whose camera is given
    /// in the world.
    void light(const GpuModel& model, const GpuModel::View& view, const scene::Camera& camera,
               const SurfaceLook& look, const Light& light, const std::vector<std::size_t>& beams,
               const ShadowMap& shadow, const Switches& switches);

    /// The scattered light on the screen, with `narrowest`, the first of the Gaussians. Once a view.
    const gl::Texture& gather(const GpuModel& model, const GpuModel::View& view, const LitFrame& lit,
                              const gl::Texture& narrowest, const scene::Camera& camera);

    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Of the last light().
    const TextureSpaceCounts& counts() const { return counts_; }

private:
    /// The maps of one material.
    struct Skin {
        std::size_t material = 0;
        UvLayout layout;
        std::size_t alike = 0;                ///< the first skin that lies alike in its map
        std::map<int, UvMaps> maps;           ///< by size; of the first alone
        std::map<int, gl::Texture> scattered; ///< by size; the weighted sum of the Gaussians
        int size = 0;                         ///< of the map lit last; 0: none
    };
    void add_skin(const GpuModel& model, std::size_t material);
    const UvMaps& maps(const GpuModel& model, const Skin& skin, int size);
    gl::Texture& scattered(Skin& skin, int size) const;
    int fitting_size(const Skin& skin, const GpuModel& model, const GpuModel::View& view,
                     const scene::Camera& camera) const;
    /// The texels to light, as a depth buffer; null if there are none.
    const gl::Texture* wanted(const Skin& skin, const UvMaps& maps, const GpuModel::View& view,
                              const scene::Camera& camera);
    void draw_irradiance(const gl::Program& irradiance, const GpuModel& model, const Skin& skin,
                         const gl::Texture& target, const gl::Texture& wanted) const;
    void blur(Skin& skin, const UvMaps& maps, const gl::Texture& wanted);
    void draw_gathered(const GpuModel& model, const GpuModel::View& view) const;

    const scene::Model& source_;
    int size_, samples_;
    bool culled_;
    float margin_mm_;                ///< light from farther is not seen
    std::vector<glm::vec3> weights_; ///< of the Gaussians that the maps hold
    glm::vec3 narrowest_weight_{0};
    UvPasses passes_;
    ProgramVariants irradiance_;
    gl::Program gather_, resolve_, add_narrowest_;
    gl::Texture gathered_samples_, depth_, gathered_, scattered_;
    gl::Framebuffer gather_target_, gathered_target_, scattered_target_;
    std::map<int, UvWorkspace> spaces_;   ///< by size
    gl::Texture nowhere_{GL_RGBA8, 1, 1}; ///< a map without a chart
    std::vector<Skin> skins_;
    std::vector<std::string> warnings_;
    TextureSpaceCounts counts_;
};

} // namespace renderer::passes
