// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "gpu_model.h"
#include "lit_frame.h"
#include "program_variants.h"
#include "screen_blur.h"
#include "shadow_map.h"

namespace renderer::passes {

/// Subsurface scattering in texture space [DEonLuebke2007]: a square irradiance map for each material,
/// blurred by a cascade of Gaussians whose widths follow a stretch map that is blurred along. The narrowest
/// Gaussian, finer than a texel, is left to the screen.
class TextureSpace {
public:
    /// Unwrap the model: charts, stretch maps and their blurs depend on nothing else.
    /// Throws support::InputError if a mesh has no texture coordinates.
    TextureSpace(const scene::Model& source, const GpuModel& model, const optics::Profile& profile,
                 const Methods& methods, int width, int height, int samples);

    /// Light the maps and blur them. Once a light.
    void light(const GpuModel& model, const SurfaceLook& look, const Light& light,
               const std::vector<std::size_t>& beams, const ShadowMap& shadow, const Switches& switches);

    /// The weighted sum of the Gaussians on the screen, `narrowest` being the first of them. Once a view.
    const gl::Texture& gather(const GpuModel& model, const GpuModel::View& view, const LitFrame& lit,
                              const gl::Texture& narrowest, const scene::Camera& camera);

    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    /// The maps of one material.
    struct Map {
        std::size_t material = 0;
        glm::vec2 uv_origin{0}, uv_scale{1};
        gl::Texture nearest, chart;
        std::vector<gl::Texture> stretch;   ///< [k]: blurred k times
        std::vector<gl::Texture> gaussians; ///< [k]: irradiance blurred k + 1 times
    };
    Map unwrapped(const scene::Model& source, const GpuModel& model, std::size_t material);
    void draw_charts(const scene::Model& source, const GpuModel& model, const Map& map) const;
    void draw_gathered(const GpuModel& model, const GpuModel::View& view) const;
    void blur(const gl::Texture& source, const gl::Texture& target, const Map& map, std::size_t step);

    int size_, samples_;
    float unit_mm_; ///< of the stretch maps: a texel's side, if the model's extent were spread over the map
    std::vector<float> sigmas_mm_;
    std::vector<glm::vec3> weights_; ///< of the Gaussians that the maps hold
    glm::vec3 narrowest_weight_{0};
    ProgramVariants irradiance_;
    gl::Program geometry_, dilate_, blur_, gather_, resolve_, add_narrowest_;
    RatioTable ratios_;
    gl::Sampler nearest_; ///< with no chart beyond the edge
    gl::Texture raw_, half_blurred_, irradiance_map_;
    gl::Texture gathered_samples_, depth_, gathered_, scattered_;
    gl::Framebuffer gather_target_, gathered_target_, scattered_target_;
    std::vector<Map> maps_;
    std::vector<std::string> warnings_;
};

} // namespace renderer::passes
