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

void ShadowMap::render(const GpuModel& model, const Light& light) {
    // Fit a box along the light's direction around the model, square across so that texels are.
    const bool vertical = std::hypot(light.direction.x, light.direction.z) < 1e-3f;
    const glm::vec3 up = vertical ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::mat4 view = glm::lookAt(glm::vec3(0), -light.direction, up);
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
    const glm::mat4 box = glm::ortho(middle.x - half_mm, middle.x + half_mm, middle.y - half_mm,
                                     middle.y + half_mm, -high.z - slack_mm, -low.z + slack_mm);
    light_from_world_ = box * view;
    texel_mm_ = 2 * half_mm / static_cast<float>(light.shadow_map_size);

    if (depth_.width() != light.shadow_map_size) {
        depth_ = gl::Texture(GL_DEPTH_COMPONENT32F, light.shadow_map_size, light.shadow_map_size);
        depth_values_ = gl::Texture(GL_R32F, light.shadow_map_size, light.shadow_map_size);
        const int blocks = (light.shadow_map_size + block_texels - 1) / block_texels;
        blocks_ = gl::Texture(GL_RG32F, blocks, blocks);
        bounds_ = gl::Texture(GL_RG32F, blocks, blocks);
    }
    sigma_texels_ = std::min(light.shadow_softness_mm / texel_mm_, widest_sigma_texels);
    const gl::Framebuffer target({&depth_values_}, &depth_);
    target.bind();
    target.clear_color(0, glm::vec4(1));
    target.clear_depth(1);
    glEnable(GL_DEPTH_TEST);
    program_.use();
    program_.set("light_from_world", light_from_world_);
    model.draw_places();
    glDisable(GL_DEPTH_TEST);
    find_bounds();
}

void ShadowMap::find_bounds() {
    const gl::Framebuffer blocks({&blocks_});
    blocks.bind();
    blocks_program_.use();
    blocks_program_.set("block", block_texels);
    depth_values_.bind(0);
    draw_screen();
    const gl::Framebuffer bounds({&bounds_});
    bounds.bind();
    bounds_program_.use();
    blocks_.bind(0);
    draw_screen();
}

void ShadowMap::bind(const gl::Program& program, const Light& light) const {
    depth_values_.bind(3);
    program.set("light_from_world", light_from_world_);
    program.set("shadow_texel_mm", texel_mm_);
    bounds_.bind(5);
    program.set("shadow_block", block_texels);
    program.set("shadow_sigma_texels", sigma_texels_);
    program.set("widest_shadow_sigma", widest_sigma_texels);
    program.set("light_direction", light.direction);
    program.set("light_irradiance", light.irradiance / level(light));
    program.set("ambient_irradiance", light.ambient_irradiance / level(light));
}

glm::vec3 ShadowMap::level(const Light& light) {
    const glm::vec3 radiance = (light.irradiance + light.ambient_irradiance) / std::numbers::pi_v<float>;
    return glm::mix(radiance, glm::vec3(1), glm::lessThanEqual(radiance, glm::vec3(0)));
}

} // namespace renderer::passes
