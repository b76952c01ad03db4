// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "depth_of_field.h"

#include <algorithm>
#include <cmath>

#include "shader_library.h"

namespace renderer::passes {
namespace {

// Wider disks, as a share of the image's height, would show the single taps.
constexpr float widest_share = 0.025f;

} // namespace

DepthOfField::DepthOfField(int width, int height, const Look& look)
    : aperture_mm_(look.aperture_mm), focus_mm_(look.focus_mm),
      program_(load_screen_program("depth_of_field.frag")), blurred_(light_format(), width, height),
      target_({&blurred_}) {
    blurred_.filter(GL_LINEAR, GL_LINEAR); // the bloom halves it
    rect_ = {0, 0, width, height};         // new memory may hold anything
}

const gl::Texture& DepthOfField::blur(const gl::Texture& color, const LitFrame& lit,
                                      const scene::Camera& camera) {
    // A thin lens spreads a point at depth d over a disk; in the plane of focus, at depth f, its diameter is
    // aperture |d - f| / d.
    const float focus_mm = focus_mm_ > 0 ? focus_mm_ : glm::length(camera.target_mm - camera.eye_mm);
    const float scale_px = 0.5f * aperture_mm_ * camera.focal_px() / focus_mm;
    const float widest_px = std::max(widest_share * static_cast<float>(camera.height), 1.0f);
    const auto radius_px = [&](float depth_mm) {
        return std::min(scale_px * std::abs(1 - focus_mm / depth_mm), widest_px);
    };
    const float near_px = lit.nearest_mm < focus_mm ? radius_px(lit.nearest_mm) : 0;
    const int reach = static_cast<int>(std::ceil(std::max(near_px, radius_px(lit.farthest_mm)))) + 1;
    const int left = std::max(lit.rect.x - reach, 0);
    const int bottom = std::max(lit.rect.y - reach, 0);
    const PixelRect rect{left, bottom, std::min(lit.rect.x + lit.rect.width + reach, camera.width) - left,
                         std::min(lit.rect.y + lit.rect.height + reach, camera.height) - bottom};
    if (rect != rect_) { // what was drawn outside
        begin_rect(target_, united(rect_, rect));
        target_.clear_color(0, glm::vec4(0));
        rect_ = rect;
    }

    program_.use();
    program_.set("focus_mm", focus_mm);
    program_.set("scale_px", scale_px);
    program_.set("widest_px", widest_px);
    program_.set("near_px", near_px);
    color.bind(0);
    lit.depth_mm.bind(1);
    begin_rect(target_, rect_);
    draw_screen();
    end_rect();
    return blurred_;
}

} // namespace renderer::passes
