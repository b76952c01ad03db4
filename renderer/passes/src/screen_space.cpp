// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "screen_space.h"

#include <renderer/optics/kernel.h>

#include "shader_library.h"

namespace renderer::passes {
namespace {

// A kernel's step never exceeds this share of the image's height, however near the camera comes.
constexpr float widest_step = 0.25f;

std::vector<float> published_taps() { return {optics::gaussian_taps.begin(), optics::gaussian_taps.end()}; }

} // namespace

std::vector<glm::vec3> profile_weights(const optics::Profile& profile) {
    std::vector<glm::vec3> weights;
    for (const optics::Gaussian& g : profile.gaussians) {
        weights.emplace_back(g.weight);
    }
    return weights;
}

void begin_rect(const gl::Framebuffer& target, const PixelRect& rect) {
    target.bind();
    target.clear_color(0, glm::vec4(0));
    glEnable(GL_SCISSOR_TEST);
    glScissor(rect.x, rect.y, rect.width, rect.height);
}

void end_rect() { glDisable(GL_SCISSOR_TEST); }

ScreenSpace::ScreenSpace(int width, int height, const optics::Profile& profile, const Methods& methods)
    : methods_(methods), weights_(profile_weights(profile)),
      stretch_(load_screen_program("screen_stretch.frag")), blur_(load_screen_program("screen_blur.frag")),
      jittered_(load_screen_program("screen_jittered.frag")), sum_(load_screen_program("weighted_sum.frag")),
      px_per_mm_(GL_RG32F, width, height), half_blurred_(GL_RGBA16F, width, height),
      scattered_(GL_RGBA16F, width, height), stretch_target_({&px_per_mm_}), half_target_({&half_blurred_}),
      scattered_target_({&scattered_}) {
    half_blurred_.filter(GL_LINEAR, GL_LINEAR, GL_MIRRORED_REPEAT);
    for (const double sigma : optics::cascade_sigmas_mm(profile)) {
        sigmas_mm_.push_back(static_cast<float>(sigma));
        gaussians_.emplace_back(GL_RGBA16F, width, height);
        gaussians_.back().filter(GL_LINEAR, GL_LINEAR, GL_MIRRORED_REPEAT);
        gaussian_targets_.emplace_back(std::vector<const gl::Texture*>{&gaussians_.back()});
    }
    blur_.set("taps", published_taps());

    std::vector<glm::vec2> offsets_mm;
    std::vector<glm::vec3> tap_weights;
    for (const optics::Tap& tap : optics::hable_kernel()) {
        offsets_mm.push_back(tap.offset * methods.jitter_unit_mm);
        tap_weights.push_back(tap.weight);
    }
    jittered_.set("tap_offsets_mm", offsets_mm);
    jittered_.set("tap_weights", tap_weights);
}

void ScreenSpace::find_stretch(const LitFrame& lit, const scene::Camera& camera, const Stretch& stretch) {
    // Physically, a width at depth d covers focal_px / d pixels, and a surface tilted by dz/dx is
    // foreshortened by about 1 / (1 + |dz/dx|), dz/dx being the gradient per pixel times focal_px / d: so
    // alpha and beta of Eqs. 2-3 are both focal_px. The published alpha is in the unit that makes 11 physical
    // for the 2009 stimuli.
    const float focal_px = camera.focal_px();
    stretch_.use();
    stretch_.set("kernel_px_mm", stretch.alpha ? *stretch.alpha * published_depth_unit_mm : focal_px);
    stretch_.set("beta_px", stretch.beta.value_or(focal_px));
    lit.depth_mm.bind(0);
    begin_rect(stretch_target_, lit.rect);
    draw_screen();
    end_rect();
    px_per_mm_.bind(1);
}

const gl::Texture& ScreenSpace::full(const LitFrame& lit, const scene::Camera& camera) {
    find_stretch(lit, camera, methods_.full_stretch);
    blur_.use();
    blur_.set("widest_px", widest_step * static_cast<float>(camera.height));
    const gl::Texture* source = &lit.diffuse;
    for (std::size_t i = 0; i < gaussians_.size(); ++i) {
        blur_.set("sigma_mm", sigmas_mm_[i]);
        begin_rect(half_target_, lit.rect);
        source->bind(0);
        blur_.set("axis", glm::ivec2(1, 0));
        draw_screen();
        end_rect();
        begin_rect(gaussian_targets_[i], lit.rect);
        half_blurred_.bind(0);
        blur_.set("axis", glm::ivec2(0, 1));
        draw_screen();
        end_rect();
        source = &gaussians_[i];
    }

    sum_.use();
    for (std::size_t i = 0; i < gaussians_.size(); ++i) {
        gaussians_[i].bind(static_cast<GLuint>(i));
    }
    sum_.set("weights", weights_);
    sum_.set("count", static_cast<int>(gaussians_.size()));
    begin_rect(scattered_target_, lit.rect);
    draw_screen();
    end_rect();
    return scattered_;
}

const gl::Texture& ScreenSpace::jittered(const LitFrame& lit, const scene::Camera& camera) {
    find_stretch(lit, camera, methods_.jitter_stretch);
    jittered_.use();
    jittered_.set("widest_px", widest_step * static_cast<float>(camera.height));
    lit.diffuse.bind(0);
    begin_rect(scattered_target_, lit.rect);
    draw_screen();
    end_rect();
    return scattered_;
}

} // namespace renderer::passes
