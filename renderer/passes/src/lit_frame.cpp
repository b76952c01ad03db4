// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "lit_frame.h"

#include <algorithm>
#include <cmath>

#include <renderer/optics/specular.h>

#include "shader_library.h"

namespace renderer::passes {

// material.glsl's table_size
constexpr int specular_table_size = 64;

PixelRect visible_rect(const scene::Camera& camera, const scene::Bounds& bounds) {
    const PixelRect whole{0, 0, camera.width, camera.height};
    const glm::mat4 view = camera.view();
    glm::vec2 low(1e30f);
    glm::vec2 high(-1e30f);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? bounds.low.x : bounds.high.x,
                          (corner & 2) ? bounds.low.y : bounds.high.y,
                          (corner & 4) ? bounds.low.z : bounds.high.z);
        const glm::vec3 v(view * glm::vec4(p, 1));
        if (v.z > -1e-3f) {
            return whole; // a corner beside or behind the camera can appear anywhere
        }
        const glm::vec2 pixel =
            glm::vec2(v) / -v.z * camera.focal_px() +
            0.5f * glm::vec2(static_cast<float>(camera.width), static_cast<float>(camera.height));
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    const auto inside = [](float value, int limit) {
        return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(limit)));
    };
    const int left = inside(std::floor(low.x) - 1, camera.width);
    const int bottom = inside(std::floor(low.y) - 1, camera.height);
    const int right = inside(std::ceil(high.x) + 1, camera.width);
    const int top = inside(std::ceil(high.y) + 1, camera.height);
    return {left, bottom, right - left, top - bottom};
}

LitFrame::LitFrame(int width, int height)
    : diffuse(GL_RGBA16F, width, height), after_scattering(GL_RGBA16F, width, height),
      specular(GL_RGBA16F, width, height), depth_mm(GL_R32F, width, height), rect{0, 0, width, height} {
    // Kernels that reach over the screen's edge see its mirror image.
    diffuse.filter(GL_LINEAR, GL_LINEAR, GL_MIRRORED_REPEAT);
}

SurfaceLook::SurfaceLook(const Look& look)
    : look_(look), specular_albedo_(GL_R32F, specular_table_size, specular_table_size) {
    const std::vector<float> table =
        optics::specular_albedo_table(specular_table_size, static_cast<double>(look.fresnel_f0));
    specular_albedo_.upload(GL_RED, GL_FLOAT, table.data());
    specular_albedo_.filter(GL_LINEAR, GL_LINEAR);
}

void SurfaceLook::bind(const gl::Program& program) const {
    specular_albedo_.bind(4);
    program.set("texture_mix", look_.texture_mix);
    program.set("specular_intensity", look_.specular_intensity);
    program.set("fresnel_f0", look_.fresnel_f0);
}

void set_camera(const gl::Program& program, const scene::Camera& camera, const scene::Bounds& bounds) {
    program.set("view_from_world", camera.view());
    program.set("clip_from_view", camera.projection(bounds));
}

LitPass::LitPass(int width, int height, int samples)
    : samples_(samples), program_(load_program("surface.vert", "lit.frag")),
      resolve_(load_screen_program(samples > 1 ? "resolve.frag" : "copy_lit.frag")),
      diffuse_(GL_RGBA16F, width, height, 1, samples), after_(GL_RGBA16F, width, height, 1, samples),
      specular_(GL_RGBA16F, width, height, 1, samples), depth_mm_(GL_R32F, width, height, 1, samples),
      depth_(GL_DEPTH_COMPONENT32F, width, height, 1, samples), frame_(width, height),
      samples_target_({&diffuse_, &after_, &specular_, &depth_mm_}, &depth_),
      target_({&frame_.diffuse, &frame_.after_scattering, &frame_.specular, &frame_.depth_mm}) {}

const LitFrame& LitPass::render(const GpuModel& model, const SurfaceLook& look, const scene::Camera& camera,
                                const Light& light, const ShadowMap& shadow) {
    // Light every sample.
    samples_target_.bind();
    for (int attachment = 0; attachment < 4; ++attachment) {
        samples_target_.clear_color(attachment, glm::vec4(0));
    }
    samples_target_.clear_depth(1);
    program_.use();
    set_camera(program_, camera, model.bounds());
    program_.set("eye_mm", camera.eye_mm);
    look.bind(program_);
    shadow.bind(program_, light);
    glEnable(GL_DEPTH_TEST);
    model.draw(program_);
    glDisable(GL_DEPTH_TEST);

    // Resolve the samples into pixels.
    target_.bind();
    resolve_.use();
    diffuse_.bind(0);
    after_.bind(1);
    specular_.bind(2);
    depth_mm_.bind(3);
    resolve_.set("samples", samples_);
    draw_screen();
    frame_.rect = visible_rect(camera, model.bounds());
    return frame_;
}

} // namespace renderer::passes
