// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "screen_blur.h"

#include <algorithm>

#include "shader_library.h"

namespace renderer::passes {
namespace {

// A kernel's step never exceeds this share of the image's height, however near the camera comes.
constexpr float widest_step = 0.25f;
constexpr int table_size = 512;
// Below this width, in pixels, a Gaussian's shape is lost between pixels, and three taps carry its variance.
constexpr float few_taps_below_px = 0.6f;

} // namespace

void begin_rect(const gl::Framebuffer& target, const PixelRect& rect) {
    target.bind();
    glEnable(GL_SCISSOR_TEST);
    glScissor(rect.x, rect.y, rect.width, rect.height);
}

void end_rect() { glDisable(GL_SCISSOR_TEST); }

GLenum blur_format(const FullMethod& method) {
    if (method.target_bits != 0) {
        return method.target_bits == 8 ? GL_SRGB8_ALPHA8 : method.target_bits == 16 ? GL_RGBA16F : GL_RGBA32F;
    }
    return light_format();
}

ScreenSurface::ScreenSurface(int width, int height)
    : program_(load_screen_program("screen_surface.frag")), depth_and_tilt_(GL_RGBA32F, width, height),
      target_({&depth_and_tilt_}) {}

void ScreenSurface::find(const gl::Texture& depth_mm, const ScreenGeometry& geometry) {
    if (geometry_.rect != geometry.rect) {
        target_.clear_color(0, glm::vec4(0));
    }
    geometry_ = geometry;
    depth_mm_ = &depth_mm;
    program_.use();
    program_.set("focal_px", geometry.focal_px);
    depth_mm.bind(0);
    begin_rect(target_, geometry.rect);
    draw_screen();
    end_rect();
}

void ScreenSurface::bind(const gl::Program& program, const Stretch& stretch) const {
    // Physically, a width at depth d covers focal_px / d pixels, and a surface tilted by dz/dx is
    // foreshortened by about 1 / (1 + |dz/dx|), dz/dx being the gradient per pixel times focal_px / d: so
    // alpha and beta of Eqs. 2-3 are both focal_px. The published alpha is in the unit that makes 11 physical
    // for the 2009 stimuli. A given alpha or beta is in pixels of the image.
    program.set("focal_px", geometry_.focal_px);
    program.set("middle_px", geometry_.middle_px);
    program.set("kernel_px_mm", stretch.alpha ? *stretch.alpha * published_depth_unit_mm * geometry_.scale
                                              : geometry_.focal_px);
    program.set("beta_px", stretch.beta ? *stretch.beta * geometry_.scale : geometry_.focal_px);
    program.set("widest_px", widest_step * static_cast<float>(geometry_.height));
    depth_and_tilt_.bind(1);
    depth_mm_->bind(2);
}

RatioTable::RatioTable(int reach)
    : end(std::max(1.36f, 0.46f * static_cast<float>(reach))), // steps are ceil(3 / reach sigma - 0.35), or 1
      texture(GL_R32F, table_size, 1) {
    std::vector<float> table;
    for (int i = 0; i < table_size; ++i) {
        const double sigma = static_cast<double>(end) * i / (table_size - 1);
        table.push_back(static_cast<float>(optics::tap_ratio(reach, sigma)));
    }
    texture.upload(GL_RED, GL_FLOAT, table.data());
    texture.filter(GL_LINEAR, GL_LINEAR);
}

ScreenBlur::Taps::Taps(int reach, const FullMethod& method) : ratios(reach) {
    Defines defines = metric_defines(method.foreshortening);
    defines["REACH"] = reach;
    defines["PUBLISHED_TAPS"] = method.published_taps ? 1 : 0;
    defines["REJECT_GAPS"] = method.reject_gaps ? 1 : 0;
    // Floats of 32 bits carry the depth along in alpha, which saves reading it; between pixels, where the
    // published taps stand, it would be no depth.
    defines["DEPTH_OUT"] = blur_format(method) == GL_RGBA32F && !method.published_taps ? 1 : 0;
    for (gl::Program* program : {&from_matte, &from_depth, &second}) {
        defines["DEPTH_IN"] = program == &from_matte ? 0 : defines["DEPTH_OUT"];
        defines["SECOND_PASS"] = program == &second ? 1 : 0;
        *program = load_screen_program("screen_blur.frag", defines);
        program->set("table_end", ratios.end);
        program->set("published_weights",
                     std::vector<float>(optics::gaussian_taps.begin() + 3, optics::gaussian_taps.end()));
    }
}

ScreenBlur::ScreenBlur(int width, int height, const FullMethod& method)
    : method_(method), taps_(method.published_taps ? 3 : method.taps / 2, method),
      few_taps_(method.published_taps ? 3 : 1, method),
      light_sampler_(method.published_taps ? GL_LINEAR : GL_NEAREST, GL_MIRRORED_REPEAT),
      depth_sampler_(GL_NEAREST, GL_MIRRORED_REPEAT),
      half_blurred_(blur_format(method), width, height), blurred_{gl::Texture(blur_format(method), width,
                                                                              height),
                                                                  gl::Texture(blur_format(method), width,
                                                                              height)},
      sum_(method.target_bits == 8 ? GL_RGBA16F : blur_format(method), width, height),
      half_target_({&half_blurred_}), targets_{gl::Framebuffer({&blurred_[0], &sum_}),
                                               gl::Framebuffer({&blurred_[1], &sum_})},
      sum_target_({&sum_}) {
    // Only the skin's rectangle is drawn; new memory may hold anything.
    sum_target_.clear_color(0, glm::vec4(0));
    for (const gl::Framebuffer* target : {&half_target_, &targets_[0], &targets_[1]}) {
        target->clear_color(0, glm::vec4(0));
    }
}

void ScreenBlur::begin(const PixelRect& rect) {
    if (rect_ != rect) {
        for (const gl::Framebuffer* target : {&half_target_, &targets_[0], &targets_[1]}) {
            target->clear_color(0, glm::vec4(0));
        }
        rect_ = rect;
    }
    begin_rect(sum_target_, rect);
    sum_target_.clear_color(0, glm::vec4(0));
    end_rect();
}

void ScreenBlur::pass(const Taps& taps, const gl::Program& program, const ScreenSurface& surface,
                      const gl::Texture& source, float sigma_mm) const {
    program.use();
    surface.bind(program, method_.stretch);
    program.set("sigma_mm", sigma_mm);
    source.bind(0);
    taps.ratios.texture.bind(3);
    light_sampler_.bind(0);
    depth_sampler_.bind(2);
    draw_screen();
    gl::Sampler::unbind(0);
    gl::Sampler::unbind(2);
}

const gl::Texture& ScreenBlur::blur(const ScreenSurface& surface, const gl::Texture& source, float sigma_mm,
                                    float widest_px, const glm::vec3& share, const gl::Texture& carried,
                                    const glm::vec3& carried_share) {
    const Taps& taps = widest_px < few_taps_below_px ? few_taps_ : taps_;
    const PixelRect& rect = surface.geometry().rect;
    const bool own = &source == &blurred_[0] || &source == &blurred_[1];
    glEnable(GL_FRAMEBUFFER_SRGB); // of effect on 8-bit targets alone
    begin_rect(half_target_, rect);
    pass(taps, own ? taps.from_depth : taps.from_matte, surface, source, sigma_mm);
    end_rect();

    taps.second.set("share", share);
    taps.second.set("carried_share", carried_share);
    carried.bind(4);
    begin_rect(targets_[next_], rect);
    glEnablei(GL_BLEND, 1);
    glBlendFunci(1, GL_ONE, GL_ONE);
    pass(taps, taps.second, surface, half_blurred_, sigma_mm);
    glDisablei(GL_BLEND, 1);
    end_rect();
    glDisable(GL_FRAMEBUFFER_SRGB);
    const gl::Texture& result = blurred_[next_];
    next_ = 1 - next_;
    return result;
}

} // namespace renderer::passes
