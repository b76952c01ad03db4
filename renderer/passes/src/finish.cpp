// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "finish.h"

#include <algorithm>
#include <cmath>

#include <renderer/optics/color.h>

#include "shader_library.h"

namespace renderer::passes {

Finish::Finish(int width, int height, const Look& look)
    : look_(look),
      depth_of_field_(look.aperture_mm > 0 ? std::make_unique<DepthOfField>(width, height, look) : nullptr),
      image_(&color_), composite_(load_screen_program("composite.frag")),
      halve_(load_screen_program("halve.frag")), bloom_(load_screen_program("bloom_blur.frag")),
      output_(load_screen_program("output.frag")), color_(light_format(), width, height),
      half_(light_format(), (width + 1) / 2, (height + 1) / 2),
      half_blurred_(light_format(), (width + 1) / 2, (height + 1) / 2), srgb_(GL_RGBA8, width, height),
      linear_(GL_RGBA32F, width, height), color_target_({&color_}), half_target_({&half_}),
      half_blurred_target_({&half_blurred_}), srgb_target_({&srgb_}), both_target_({&srgb_, &linear_}) {
    color_.filter(GL_LINEAR, GL_LINEAR);
    half_.filter(GL_LINEAR, GL_LINEAR);
    half_blurred_.filter(GL_LINEAR, GL_LINEAR);
    rect_ = {0, 0, width, height}; // new memory may hold anything
    half_rect_ = {0, 0, half_.width(), half_.height()};
}

void Finish::composite(const gl::Texture& scattered, const LitFrame& lit) {
    if (lit.rect != rect_) { // what was drawn outside
        begin_rect(color_target_, united(rect_, lit.rect));
        color_target_.clear_color(0, glm::vec4(0));
        rect_ = lit.rect;
    }
    begin_rect(color_target_, rect_);
    composite_.use();
    level_ = lit.level;
    scattered.bind(0);
    lit.after_scattering.bind(1);
    lit.specular.bind(2);
    draw_screen();
    end_rect();
    image_ = &color_;
    shown_ = rect_;
}

void Finish::depth_of_field(const LitFrame& lit, const scene::Camera& camera) {
    image_ = &depth_of_field_->blur(color_, lit, camera);
    shown_ = depth_of_field_->rect();
}

/// What the bloom reaches, at half the resolution.
PixelRect Finish::bloom_rect() const {
    const int reach = static_cast<int>(std::ceil(1.5f * look_.bloom_sigma_px)) + 2;
    const int left = std::max(shown_.x / 2 - reach, 0);
    const int bottom = std::max(shown_.y / 2 - reach, 0);
    return {left, bottom, std::min((shown_.x + shown_.width + 1) / 2 + reach, half_.width()) - left,
            std::min((shown_.y + shown_.height + 1) / 2 + reach, half_.height()) - bottom};
}

void Finish::bloom() {
    const PixelRect rect = bloom_rect();
    if (rect != half_rect_) { // what was drawn outside
        for (const gl::Framebuffer* target : {&half_target_, &half_blurred_target_}) {
            begin_rect(*target, united(half_rect_, rect));
            target->clear_color(0, glm::vec4(0));
        }
        half_rect_ = rect;
    }
    begin_rect(half_target_, rect);
    halve_.use();
    image_->bind(0);
    draw_screen();
    bloom_.use();
    bloom_.set("sigma_px", std::max(0.5f * look_.bloom_sigma_px, 1e-3f));
    begin_rect(half_blurred_target_, rect);
    half_.bind(0);
    bloom_.set("axis", glm::ivec2(1, 0));
    draw_screen();
    begin_rect(half_target_, rect);
    half_blurred_.bind(0);
    bloom_.set("axis", glm::ivec2(0, 1));
    draw_screen();
    end_rect();
}

void Finish::output(bool with_linear) {
    output_background(with_linear);
    PixelRect rect = shown_;
    if (blooms()) {
        const PixelRect half = bloom_rect();
        rect = {2 * half.x, 2 * half.y, 2 * half.width, 2 * half.height};
    }
    rect.y = color_.height() - rect.y - rect.height; // row 0 is the image's top
    begin_rect(with_linear ? both_target_ : srgb_target_, rect);
    output_.use();
    output_.set("bloom_strength", blooms() ? look_.bloom_strength : 0.0f);
    output_.set("skin_exposure", look_.exposure * level_);
    output_.set("background", look_.exposure * look_.background);
    image_->bind(0);
    half_.bind(1);
    draw_screen();
    end_rect();
}

void Finish::output_background(bool with_linear) {
    const glm::vec3 background = look_.exposure * look_.background;
    glm::vec4 srgb(1);
    for (int c = 0; c < 3; ++c) {
        // Half a step from the border between two steps, so that all rounding is alike.
        const double encoded =
            optics::srgb_from_linear(std::clamp(static_cast<double>(background[c]), 0.0, 1.0));
        srgb[c] = static_cast<float>(std::round(255 * encoded) / 255);
    }
    srgb_target_.clear_color(0, srgb);
    if (with_linear) {
        both_target_.clear_color(1, glm::vec4(background, 0));
    }
}

Frame Finish::read(bool with_linear) const {
    Frame frame;
    frame.width = color_.width();
    frame.height = color_.height();
    const std::size_t pixels = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
    frame.srgb.resize(pixels * 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(srgb_.id(), 0, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(frame.srgb.size()),
                      frame.srgb.data());
    if (with_linear) {
        frame.linear.resize(pixels * 4);
        glGetTextureImage(linear_.id(), 0, GL_RGBA, GL_FLOAT,
                          static_cast<GLsizei>(frame.linear.size() * sizeof(float)), frame.linear.data());
    }
    return frame;
}

} // namespace renderer::passes
