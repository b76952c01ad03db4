// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "shadow_map.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "shader_library.h"

namespace renderer::passes {

// A wider filter than this many texels would cost more than its smoothness is worth.
constexpr float widest_sigma_texels = 4;

ShadowMap::ShadowMap()
    : program_(load_program("shadow.vert", "shadow.frag")),
      bounds_program_(load_screen_program("shadow_bounds.frag")) {}

void ShadowMap::render(const GpuModel& model, const Light& light) {
    // Fit a box along the light's direction around the model, square across so that texels are.
    const glm::vec3 up = std::abs(light.direction.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::mat4 view = glm::lookAt(light.direction, glm::vec3(0), up);
    glm::vec3 low(1e30f);
    glm::vec3 high(-1e30f);
    for (const glm::vec3& place : model.places_mm()) {
        const glm::vec3 p(view * glm::vec4(place, 1));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec2 middle = 0.5f * glm::vec2(low + high);
    const float half_mm = 0.5f * std::max({high.x - low.x, high.y - low.y, 1e-3f}) * 1.02f;
    const float slack_mm = 0.02f * (high.z - low.z) + 1;
    const glm::mat4 box = glm::ortho(middle.x - half_mm, middle.x + half_mm, middle.y - half_mm,
                                     middle.y + half_mm, -high.z - slack_mm, -low.z + slack_mm);
    light_from_world_ = box * view;
    texel_mm_ = 2 * half_mm / static_cast<float>(light.shadow_map_size);

    if (depth_.width() != light.shadow_map_size) {
        depth_ = gl::Texture(GL_DEPTH_COMPONENT32F, light.shadow_map_size, light.shadow_map_size);
        depth_.filter(GL_LINEAR, GL_LINEAR);
        glTextureParameteri(depth_.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTextureParameteri(depth_.id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
        depth_values_ = gl::Texture(GL_R32F, light.shadow_map_size, light.shadow_map_size);
        half_bounds_ = gl::Texture(GL_RG32F, light.shadow_map_size, light.shadow_map_size);
        bounds_ = gl::Texture(GL_RG32F, light.shadow_map_size, light.shadow_map_size);
    }
    sigma_texels_ = std::min(light.shadow_softness_mm / texel_mm_, widest_sigma_texels);
    reach_texels_ = static_cast<int>(std::ceil(2 * sigma_texels_));
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
    bounds_program_.use();
    bounds_program_.set("reach", reach_texels_ + 1); // the sampler interpolates between a tap's neighbours
    const gl::Framebuffer half({&half_bounds_});
    half.bind();
    depth_values_.bind(0);
    bounds_program_.set("axis", glm::ivec2(1, 0));
    bounds_program_.set("first_pass", 1);
    draw_screen();
    const gl::Framebuffer whole({&bounds_});
    whole.bind();
    half_bounds_.bind(0);
    bounds_program_.set("axis", glm::ivec2(0, 1));
    bounds_program_.set("first_pass", 0);
    draw_screen();
}

void ShadowMap::bind(const gl::Program& program, const Light& light) const {
    depth_.bind(3);
    program.set("light_from_world", light_from_world_);
    program.set("shadow_texel_mm", texel_mm_);
    bounds_.bind(5);
    program.set("shadow_sigma_texels", sigma_texels_);
    program.set("shadow_reach", reach_texels_);
    program.set("light_direction", light.direction);
    program.set("light_irradiance", light.irradiance);
    program.set("ambient_irradiance", light.ambient_irradiance);
}

} // namespace renderer::passes
