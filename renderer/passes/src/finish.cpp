// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "finish.h"

#include <algorithm>

#include "shader_library.h"

namespace renderer::passes {

Finish::Finish(int width, int height, const Look& look)
    : look_(look), composite_(load_screen_program("composite.frag")),
      halve_(load_screen_program("halve.frag")), bloom_(load_screen_program("bloom_blur.frag")),
      output_(load_screen_program("output.frag")), color_(light_format(), width, height),
      half_(light_format(), (width + 1) / 2, (height + 1) / 2),
      half_blurred_(light_format(), (width + 1) / 2, (height + 1) / 2), srgb_(GL_RGBA8, width, height),
      linear_(GL_RGBA32F, width, height), color_target_({&color_}), half_target_({&half_}),
      half_blurred_target_({&half_blurred_}), srgb_target_({&srgb_}), both_target_({&srgb_, &linear_}) {
    color_.filter(GL_LINEAR, GL_LINEAR);
    half_.filter(GL_LINEAR, GL_LINEAR);
    half_blurred_.filter(GL_LINEAR, GL_LINEAR);
}

void Finish::composite(const gl::Texture& scattered, const LitFrame& lit) {
    color_target_.bind();
    composite_.use();
    level_ = lit.level;
    scattered.bind(0);
    lit.after_scattering.bind(1);
    lit.specular.bind(2);
    draw_screen();
}

void Finish::bloom() {
    if (look_.bloom_strength <= 0 || look_.bloom_sigma_px <= 0) {
        return;
    }
    half_target_.bind();
    halve_.use();
    color_.bind(0);
    draw_screen();
    bloom_.use();
    bloom_.set("sigma_px", std::max(0.5f * look_.bloom_sigma_px, 1e-3f));
    half_blurred_target_.bind();
    half_.bind(0);
    bloom_.set("axis", glm::vec2(1, 0));
    draw_screen();
    half_target_.bind();
    half_blurred_.bind(0);
    bloom_.set("axis", glm::vec2(0, 1));
    draw_screen();
}

Frame Finish::output(bool with_linear) {
    const bool blooms = look_.bloom_strength > 0 && look_.bloom_sigma_px > 0;
    (with_linear ? both_target_ : srgb_target_).bind();
    output_.use();
    output_.set("bloom_strength", blooms ? look_.bloom_strength : 0.0f);
    output_.set("skin_exposure", look_.exposure * level_);
    output_.set("background", look_.exposure * look_.background);
    color_.bind(0);
    half_.bind(1);
    draw_screen();

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
