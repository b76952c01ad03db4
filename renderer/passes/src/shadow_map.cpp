// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "shadow_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "shader_library.h"

namespace renderer::passes {

// A wider filter than this many texels would cost more than its smoothness is worth.
constexpr float widest_sigma_texels = 4;
// Bounds are kept for blocks of this many texels a side; those of a block and its neighbours hold for any
// filter in the block, whose reach is at most 2 x 4 texels, and one for the four that are gathered at a time.
constexpr int block_texels = 10;

ShadowMap::ShadowMap()
    : program_(load_program("shadow.vert", "shadow.frag")),
      blocks_program_(load_screen_program("shadow_blocks.frag")),
      bounds_program_(load_screen_program("shadow_bounds.frag")) {}

namespace {

/// A box along the light's direction around the model, square across so that texels are.
glm::mat4 fitted_box(const GpuModel& model, const glm::vec3& direction, float& side_mm) {
    const bool vertical = std::hypot(direction.x, direction.z) < 1e-3f;
    const glm::vec3 up = vertical ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::mat4 view = glm::lookAt(glm::vec3(0), -direction, up);
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    for (const glm::vec3& place : model.places_mm()) {
        const glm::vec3 p(view * glm::vec4(place, 1));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec2 middle = 0.5f * glm::vec2(low + high);
    const float half_mm = 0.51f * std::max({high.x - low.x, high.y - low.y, 1e-3f * model.extent_mm()});
    const float slack_mm = 0.02f * model.extent_mm();
    side_mm = 2 * half_mm;
    return glm::ortho(middle.x - half_mm, middle.x + half_mm, middle.y - half_mm, middle.y + half_mm,
                      -high.z - slack_mm, -low.z + slack_mm) *
           view;
}

} // namespace

void ShadowMap::allocate(int size, int layers) {
    if (depths_.width() == size && depths_.layers() >= layers && depths_.id() != 0) {
        layers_.resize(static_cast<std::size_t>(depths_.layers()));
        return;
    }
    const int blocks = (size + block_texels - 1) / block_texels;
    depth_ = gl::Texture(GL_DEPTH_COMPONENT32F, size, size);
    depths_ = gl::Texture::array(GL_R32F, size, size, layers);
    blocks_ = gl::Texture(GL_RG32F, blocks, blocks);
    bounds_ = gl::Texture::array(GL_RG32F, blocks, blocks, layers);
    layers_.assign(static_cast<std::size_t>(layers), std::nullopt);
}

bool ShadowMap::holds(const Light& light, const std::vector<std::size_t>& beams) const {
    const std::vector<scene::Beam> all = light.beams();
    return depths_.id() != 0 && depths_.width() == light.shadow_map_size &&
           std::all_of(beams.begin(), beams.end(), [&](std::size_t beam) {
               return beam < layers_.size() && layers_[beam] &&
                      layers_[beam]->direction == all[beam].direction;
           });
}

int ShadowMap::render(const GpuModel& model, const Light& light, const std::vector<std::size_t>& beams) {
    const std::vector<scene::Beam> all = light.beams();
    allocate(light.shadow_map_size, static_cast<int>(all.size()));
    int rendered = 0;
    for (const std::size_t beam : beams) {
        std::optional<Layer>& layer = layers_[beam];
        if (layer && layer->direction == all[beam].direction) {
            continue;
        }
        float side_mm = 1;
        layer = Layer{all[beam].direction, fitted_box(model, all[beam].direction, side_mm), 1};
        layer->texel_mm = side_mm / static_cast<float>(light.shadow_map_size);
        const gl::Framebuffer target(depths_, static_cast<int>(beam), &depth_);
        target.bind();
        target.clear_color(0, glm::vec4(1));
        target.clear_depth(1);
        glEnable(GL_DEPTH_TEST);
        program_.use();
        program_.set("light_from_world", layer->light_from_world);
        model.draw_places();
        glDisable(GL_DEPTH_TEST);
        find_bounds(static_cast<int>(beam));
        ++rendered;
    }
    return rendered;
}

void ShadowMap::find_bounds(int layer) {
    const gl::Framebuffer blocks({&blocks_});
    blocks.bind();
    blocks_program_.use();
    blocks_program_.set("block", block_texels);
    blocks_program_.set("layer", layer);
    depths_.bind(0);
    draw_screen();
    const gl::Framebuffer bounds(bounds_, layer);
    bounds.bind();
    bounds_program_.use();
    blocks_.bind(0);
    draw_screen();
}

void ShadowMap::bind(const gl::Program& program, const Light& light,
                     const std::vector<std::size_t>& beams) const {
    const std::vector<scene::Beam> all = light.beams();
    std::vector<glm::vec3> directions, irradiances;
    std::vector<glm::mat4> boxes;
    std::vector<float> texels_mm, sigmas;
    std::vector<int> layers;
    for (const std::size_t beam : beams) {
        const Layer& layer = *layers_[beam];
        directions.push_back(all[beam].direction);
        irradiances.push_back(all[beam].irradiance / level(light));
        boxes.push_back(layer.light_from_world);
        texels_mm.push_back(layer.texel_mm);
        sigmas.push_back(std::min(light.shadow_softness_mm / layer.texel_mm, widest_sigma_texels));
        layers.push_back(static_cast<int>(beam));
    }
    program.set("light_direction", directions);
    program.set("light_irradiance", irradiances);
    program.set("light_from_world", boxes);
    program.set("shadow_texel_mm", texels_mm);
    program.set("shadow_sigma_texels", sigmas);
    program.set("shadow_layer", layers);
    depths_.bind(3);
    bounds_.bind(5);
    program.set("shadow_block", block_texels);
    program.set("widest_shadow_sigma", widest_sigma_texels);
    program.set("ambient_irradiance", light.ambient_irradiance / level(light));
}

glm::vec3 ShadowMap::level(const Light& light) {
    glm::vec3 irradiance = light.ambient_irradiance;
    for (const scene::Beam& beam : light.beams()) {
        irradiance += beam.irradiance;
    }
    const glm::vec3 radiance = irradiance / std::numbers::pi_v<float>;
    return glm::mix(radiance, glm::vec3(1), glm::lessThanEqual(radiance, glm::vec3(0)));
}

} // namespace renderer::passes
