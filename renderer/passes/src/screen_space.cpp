// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "screen_space.h"

#include <algorithm>
#include <cmath>

#include "shader_library.h"

namespace renderer::passes {
namespace {

// A Gaussian below this width changes no pixel that can be told from its neighbours: variance 0.04 beside the
// 0.083 of the pixel's own square.
constexpr float narrowest_px = 0.2f;
// Halving and enlarging the image adds a variance of 0.25 and 0.75 pixels squared; from this width on, that
// can be taken off the Gaussian.
constexpr float half_resolution_px = 2.5f;
constexpr float half_resolution_variance_px2 = 1;

ScreenGeometry geometry(const LitFrame& lit, const scene::Camera& camera) {
    return {camera.focal_px(),
            0.5f * glm::vec2(static_cast<float>(camera.width), static_cast<float>(camera.height)),
            camera.height, lit.rect, 1};
}

/// The rectangle at half the resolution, rounded outwards.
PixelRect half_of(const PixelRect& rect) {
    const int right = (rect.x + rect.width + 1) / 2;
    const int top = (rect.y + rect.height + 1) / 2;
    return {rect.x / 2, rect.y / 2, right - rect.x / 2, top - rect.y / 2};
}

} // namespace

ScreenSpace::Half::Half(int width, int height, const FullMethod& method)
    : halve(load_screen_program("halve_skin.frag")), enlarge(load_screen_program("enlarge_skin.frag")),
      source(blur_format(method), width, height), depth_mm(GL_R32F, width, height),
      target({&source, &depth_mm}), surface(width, height), blur(width, height, method) {}

ScreenSpace::ScreenSpace(int width, int height, const optics::Profile& profile, const Methods& methods)
    : methods_(methods), profile_(profile), surface_(width, height), blur_(width, height, methods.full),
      jittered_(load_screen_program("screen_jittered.frag", metric_defines(methods.jittered.foreshortening))),
      scattered_(light_format(), width, height), scattered_target_({&scattered_}) {
    if (methods.full.half_resolution) {
        half_ = std::make_unique<Half>((width + 1) / 2, (height + 1) / 2, methods.full);
    }
    scattered_target_.clear_color(0, glm::vec4(0)); // only the skin's rectangle is drawn
    const bool hable = methods.jittered.taps == 13;
    std::vector<glm::vec2> offsets_mm;
    std::vector<glm::vec3> tap_weights;
    for (const optics::Tap& tap :
         hable ? optics::hable_kernel() : optics::sunflower_kernel(profile, methods.jittered.taps)) {
        offsets_mm.push_back(tap.offset * (hable ? methods.jittered.unit_mm : 1));
        tap_weights.push_back(tap.weight);
    }
    jittered_.set("tap_count", static_cast<int>(offsets_mm.size()));
    jittered_.set("tap_offsets_mm", offsets_mm);
    jittered_.set("tap_weights", tap_weights);
}

void ScreenSpace::find_surface(const LitFrame& lit, const scene::Camera& camera) {
    surface_.find(lit.depth_mm, geometry(lit, camera));
}

const gl::Texture& ScreenSpace::full(const LitFrame& lit, const scene::Camera& camera) {
    find_surface(lit, camera);
    blur_.begin(lit.rect);
    const Stretch& stretch = methods_.full.stretch;
    const float kernel_px_mm = stretch.alpha ? *stretch.alpha * published_depth_unit_mm : camera.focal_px();
    const float widest_px_per_mm = kernel_px_mm / lit.nearest_mm;
    const float middle_px_per_mm = kernel_px_mm / lit.middle_mm;
    const gl::Texture* source = &lit.diffuse;
    double reached_mm2 = 0;     // variance of the source
    glm::vec3 carried_share{0}; // of Gaussians too narrow to be seen
    bool at_half = false;
    for (const optics::Gaussian& gaussian : profile_.gaussians) {
        const auto share = glm::vec3(gaussian.weight);
        const auto sigma_mm =
            static_cast<float>(std::sqrt(std::max(gaussian.variance_mm2 - reached_mm2, 0.0)));
        const bool last = &gaussian == &profile_.gaussians.back();
        if (!methods_.full.published_taps && sigma_mm * widest_px_per_mm < narrowest_px && !last) {
            carried_share += share;
            continue;
        }
        float wanted_mm = sigma_mm;
        if (half_ && !at_half && carried_share == glm::vec3(0) &&
            sigma_mm * middle_px_per_mm >= half_resolution_px) {
            begin_half(*source, lit, camera);
            source = &half_->source;
            at_half = true;
            wanted_mm = std::sqrt(sigma_mm * sigma_mm -
                                  half_resolution_variance_px2 / (middle_px_per_mm * middle_px_per_mm));
        }
        ScreenBlur& blur = at_half ? half_->blur : blur_;
        const ScreenSurface& surface = at_half ? half_->surface : surface_;
        source = &blur.blur(surface, *source, wanted_mm, sigma_mm * widest_px_per_mm, share,
                            at_half ? half_->source : lit.diffuse, carried_share);
        carried_share = glm::vec3(0);
        reached_mm2 = gaussian.variance_mm2;
    }
    if (at_half) {
        end_half(lit);
    }
    return blur_.sum();
}

void ScreenSpace::begin_half(const gl::Texture& source, const LitFrame& lit, const scene::Camera& camera) {
    ScreenGeometry half = geometry(lit, camera);
    half.focal_px *= 0.5f;
    half.middle_px *= 0.5f;
    half.height = (half.height + 1) / 2;
    half.rect = half_of(half.rect);
    half.scale = 0.5f;
    half_->halve.use();
    source.bind(0);
    lit.depth_mm.bind(1);
    half_->target.clear_color(0, glm::vec4(0));
    half_->target.clear_color(1, glm::vec4(0));
    glEnable(GL_FRAMEBUFFER_SRGB); // of effect on 8-bit targets alone
    begin_rect(half_->target, half.rect);
    draw_screen();
    end_rect();
    glDisable(GL_FRAMEBUFFER_SRGB);
    half_->surface.find(half_->depth_mm, half);
    half_->blur.begin(half.rect);
}

void ScreenSpace::end_half(const LitFrame& lit) {
    half_->enlarge.use();
    half_->enlarge.set("sigma_mm", static_cast<float>(std::sqrt(profile_.gaussians.back().variance_mm2)));
    half_->blur.sum().bind(0);
    lit.depth_mm.bind(1);
    half_->depth_mm.bind(2);
    blur_.sum_target().bind();
    glEnable(GL_SCISSOR_TEST);
    glScissor(lit.rect.x, lit.rect.y, lit.rect.width, lit.rect.height);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    draw_screen();
    glDisable(GL_BLEND);
    end_rect();
}

const gl::Texture& ScreenSpace::jittered(const LitFrame& lit, const scene::Camera& camera) {
    find_surface(lit, camera);
    jittered_.use();
    surface_.bind(jittered_, methods_.jittered.stretch);
    lit.diffuse.bind(0);
    begin_rect(scattered_target_, lit.rect);
    draw_screen();
    end_rect();
    return scattered_;
}

const gl::Texture& ScreenSpace::narrowest(const LitFrame& lit, const scene::Camera& camera) {
    const auto sigma_mm = static_cast<float>(std::sqrt(profile_.gaussians.front().variance_mm2));
    const float widest_px = sigma_mm * camera.focal_px() / lit.nearest_mm;
    if (widest_px < narrowest_px) {
        return lit.diffuse;
    }
    if (!narrowest_) {
        narrowest_ = std::make_unique<ScreenBlur>(camera.width, camera.height, FullMethod{});
    }
    find_surface(lit, camera);
    narrowest_->begin(lit.rect);
    return narrowest_->blur(surface_, lit.diffuse, sigma_mm, widest_px, glm::vec3(0), lit.diffuse,
                            glm::vec3(0));
}

} // namespace renderer::passes
