// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "lit_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <renderer/gl/context.h>
#include <renderer/optics/specular.h>

#include "shader_library.h"

namespace renderer::passes {

// material.glsl's table_size
constexpr int specular_table_size = 64;
// Shadows are free of acne at grazing views from 0.2 on.
constexpr float slant_lift = 0.3f;

PixelRect visible_rect(const scene::Camera& camera, const scene::Bounds& bounds) {
    const PixelRect whole{0, 0, camera.width, camera.height};
    const glm::mat3 rotation = camera.rotation();
    glm::vec2 low(std::numeric_limits<float>::infinity());
    glm::vec2 high = -low;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? bounds.low.x : bounds.high.x,
                          (corner & 2) ? bounds.low.y : bounds.high.y,
                          (corner & 4) ? bounds.low.z : bounds.high.z);
        const glm::vec3 v = rotation * (p - camera.eye_mm);
        if (v.z >= 0) {
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

namespace {

/// The depths of a frame, from the model's bounding sphere.
void find_depths(LitFrame& frame, const scene::Camera& camera, const scene::Bounds& bounds) {
    const glm::vec3 middle = camera.rotation() * (0.5f * (bounds.low + bounds.high) - camera.eye_mm);
    const float radius_mm = 0.5f * glm::length(bounds.high - bounds.low);
    constexpr float share_in_front = 1e-3f; // of the radius, where the camera is beside or inside the model
    frame.nearest_mm = std::max(-middle.z - radius_mm, share_in_front * radius_mm);
    frame.middle_mm = std::max(-middle.z, share_in_front * radius_mm);
}

} // namespace

GLenum light_format() { return gl::runs_on_cpu() ? GL_RGBA32F : GL_RGBA16F; }

LitFrame::LitFrame(int width, int height)
    : diffuse(light_format(), width, height), after_scattering(light_format(), width, height),
      specular(light_format(), width, height), depth_mm(GL_R32F, width, height), rect{0, 0, width, height} {
    // Kernels that reach over the screen's edge see its mirror image.
    diffuse.filter(GL_LINEAR, GL_LINEAR, GL_MIRRORED_REPEAT);
}

namespace {

/// The table of a Fresnel reflectance. It takes a second to compute, so it is kept for later pipelines.
const std::vector<float>& specular_table(float fresnel_f0) {
    static std::map<float, std::vector<float>> tables;
    std::vector<float>& table = tables[fresnel_f0];
    if (table.empty()) {
        table = optics::specular_albedo_table(specular_table_size, static_cast<double>(fresnel_f0));
    }
    return table;
}

} // namespace

SurfaceLook::SurfaceLook(const Look& look)
    : look_(look), specular_albedo_(GL_R32F, specular_table_size, specular_table_size) {
    const std::vector<float>& table = specular_table(look.fresnel_f0);
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
    program.set("view_from_world", camera.rotation());
    program.set("eye_mm", camera.eye_mm);
    program.set("beyond_mm", std::numeric_limits<float>::max());
    program.set("clip_from_view", camera.projection(bounds));
}

ReversedDepth::ReversedDepth() {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

ReversedDepth::~ReversedDepth() {
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

LitPass::Samples::Samples(int width, int height, int count, const gl::Texture& depth)
    : resolve(load_screen_program("resolve.frag")), diffuse(light_format(), width, height, 1, count),
      after(light_format(), width, height, 1, count), specular(light_format(), width, height, 1, count),
      depth_mm(GL_R32F, width, height, 1, count), target({&diffuse, &after, &specular, &depth_mm}, &depth) {}

LitPass::LitPass(int width, int height, int samples)
    : sample_count_(samples), program_(load_program("surface.vert", "lit.frag")),
      depth_(GL_DEPTH_COMPONENT32F, width, height, 1, samples), frame_(width, height),
      samples_(samples > 1 ? std::make_unique<Samples>(width, height, samples, depth_) : nullptr),
      target_({&frame_.diffuse, &frame_.after_scattering, &frame_.specular, &frame_.depth_mm},
              samples > 1 ? nullptr : &depth_) {}

void LitPass::resolve() {
    target_.bind();
    samples_->resolve.use();
    samples_->diffuse.bind(0);
    samples_->after.bind(1);
    samples_->specular.bind(2);
    samples_->depth_mm.bind(3);
    samples_->resolve.set("samples", sample_count_);
    draw_screen();
}

const LitFrame& LitPass::render(const GpuModel& model, const SurfaceLook& look,
                                const scene::Camera& world_camera, const Light& light,
                                const ShadowMap& shadow) {
    // Light every sample.
    const gl::Framebuffer& target = samples_ ? samples_->target : target_;
    target.bind();
    for (int attachment = 0; attachment < 4; ++attachment) {
        target.clear_color(attachment, glm::vec4(0));
    }
    target.clear_depth(0);
    program_.use();
    const scene::Camera camera = model.seen_by(world_camera);
    set_camera(program_, camera, model.bounds());
    look.bind(program_);
    shadow.bind(program_, light);
    program_.set("slant_lift", slant_lift);
    {
        const ReversedDepth depth;
        model.draw(program_);
    }

    if (samples_) {
        resolve();
    }
    frame_.level = ShadowMap::level(light);
    frame_.rect = visible_rect(camera, model.bounds());
    find_depths(frame_, camera, model.bounds());
    return frame_;
}

} // namespace renderer::passes
