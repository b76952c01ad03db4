// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "screen_blur.h"

#include <algorithm>

#include "shader_library.h"

namespace renderer::passes {
namespace {

constexpr int table_size = 512;
// Below this width, in pixels, a Gaussian's shape is lost between pixels, and three taps carry its variance.
constexpr float few_taps_below_px = 0.6f;

std::vector<gl::Framebuffer> framebuffers(const std::vector<gl::Texture>& blurred, const gl::Texture& sum,
                                          const gl::Texture& depth, bool on_the_fly) {
    std::vector<gl::Framebuffer> result;
    for (const gl::Texture& texture : blurred) {
        result.push_back(on_the_fly ? gl::Framebuffer({&texture, &sum}, &depth)
                                    : gl::Framebuffer({&texture}, &depth));
    }
    return result;
}

std::vector<gl::Texture> textures(std::size_t count, GLenum format, int width, int height) {
    std::vector<gl::Texture> result;
    for (std::size_t i = 0; i < count; ++i) {
        result.emplace_back(format, width, height);
    }
    return result;
}

} // namespace

GLenum blur_format(const FullMethod& method) {
    if (method.target_bits != 0) {
        return method.target_bits == 8 ? GL_SRGB8_ALPHA8 : method.target_bits == 16 ? GL_RGBA16F : GL_RGBA32F;
    }
    return light_format();
}

/// Floats of 32 bits carry the depth along in alpha, which saves reading it; between pixels, where the
/// published taps stand, it would be no depth.
bool ScreenBlur::carries_depth(const FullMethod& method) {
    return blur_format(method) == GL_RGBA32F && !method.published_taps;
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

ScreenBlur::Taps::Taps(int reach, const FullMethod& method, bool early_test) : ratios(reach) {
    Defines defines{{"REACH", reach},
                    {"PUBLISHED_TAPS", method.published_taps ? 1 : 0},
                    {"REJECT_GAPS", method.reject_gaps ? 1 : 0},
                    {"EARLY_TEST", early_test ? 1 : 0},
                    {"DEPTH_OUT", ScreenBlur::carries_depth(method) ? 1 : 0}};
    for (gl::Program* program : {&from_matte, &from_depth, &second}) {
        defines["DEPTH_IN"] = program == &from_matte ? 0 : defines["DEPTH_OUT"];
        defines["SECOND_PASS"] = program == &second ? 1 : 0;
        *program = load_screen_program("screen_blur.frag", defines);
        program->set("table_end", ratios.end);
        program->set("published_weights",
                     std::vector<float>(optics::gaussian_taps.begin() + 3, optics::gaussian_taps.end()));
    }
}

ScreenBlur::ScreenBlur(const ScreenSurface& surface, int width, int height, const FullMethod& method,
                       std::size_t gaussians, bool early_test)
    : surface_(surface), method_(method), early_test_(early_test),
      taps_(method.published_taps ? 3 : method.taps / 2, method, early_test),
      few_taps_(method.published_taps ? 3 : 1, method, early_test),
      copy_(load_screen_program("copy_skin.frag", {{"DEPTH_OUT", carries_depth(method) ? 1 : 0}})),
      weigh_(load_screen_program("weighted_sum.frag")), light_sampler_(GL_LINEAR, GL_MIRRORED_REPEAT),
      half_blurred_(blur_format(method), width, height),
      sum_(method.target_bits == 8 ? GL_RGBA16F : blur_format(method), width, height),
      blurred_(textures(method.accumulation == Accumulation::on_the_fly ? 1 : gaussians, blur_format(method),
                        width, height)),
      targets_(framebuffers(blurred_, sum_, surface.depth_buffer(),
                            method.accumulation == Accumulation::on_the_fly)),
      half_target_({&half_blurred_}, &surface.depth_buffer()), sum_target_({&sum_}) {
    // Only skin is drawn; new memory may hold anything.
    sum_target_.clear_color(0, glm::vec4(0));
    clear_blurred();
}

void ScreenBlur::clear_blurred() {
    half_target_.clear_color(0, glm::vec4(0));
    for (const gl::Framebuffer& target : targets_) {
        target.clear_color(0, glm::vec4(0));
    }
}

void ScreenBlur::begin(const gl::Texture& unblurred, bool has_depth) {
    // Where there is no skin nothing is drawn, and the matte has to be 0: in the rectangle, and beside it,
    // where taps reach and an earlier frame may have had skin.
    begin_rect(half_target_, united(rect_, surface_.geometry().rect));
    clear_blurred();
    end_rect();
    rect_ = surface_.geometry().rect;
    unblurred_ = source_ = &unblurred;
    unblurred_has_depth_ = has_depth;
    next_ = 0;
    sum_started_ = false;
    weight_ = glm::vec3(0);
    kept_weights_.assign(1 + blurred_.size(), glm::vec3(0));
}

glm::vec3 ScreenBlur::add_weight(const glm::vec3& weight) {
    if (method_.accumulation == Accumulation::weighted_sum) {
        kept_weights_[next_] += weight;
    }
    weight_ += weight;
    return glm::mix(weight / weight_, glm::vec3(0), glm::equal(weight_, glm::vec3(0)));
}

void ScreenBlur::pass(const Taps& taps, const gl::Program& program, const gl::Framebuffer& target,
                      const gl::Texture& source, float sigma_mm, float before_mm) {
    program.use();
    surface_.bind(program);
    program.set("sigma_mm", sigma_mm);
    source.bind(0);
    taps.ratios.texture.bind(3);
    if (method_.published_taps) {
        light_sampler_.bind(0);
    }
    begin_rect(target, surface_.geometry().rect);
    {
        const EarlyTest test(program, surface_, before_mm, early_test_);
        draw_screen();
    }
    end_rect();
    gl::Sampler::unbind(0);
}

/// Begin blurred light and sum with the unblurred light, for pixels that no Gaussian reaches.
void ScreenBlur::keep_unblurred() {
    copy_.use();
    surface_.bind(copy_);
    unblurred_->bind(0);
    glEnable(GL_FRAMEBUFFER_SRGB); // of effect on 8-bit targets alone
    begin_rect(targets_[0], surface_.geometry().rect);
    draw_screen();
    end_rect();
    glDisable(GL_FRAMEBUFFER_SRGB);
    source_ = blurred_.data();
    sum_started_ = true;
}

void ScreenBlur::blur(float sigma_mm, float widest_px, const glm::vec3& weight, float before_mm) {
    const bool on_the_fly = method_.accumulation == Accumulation::on_the_fly;
    if (before_mm > 0) {
        // Pixels beyond keep what they have; they must not lend an earlier pass's light to others.
        if (!sum_started_) {
            keep_unblurred();
        }
        begin_rect(half_target_, surface_.geometry().rect);
        half_target_.clear_color(0, glm::vec4(0));
        end_rect();
    }
    const Taps& taps = widest_px < few_taps_below_px ? few_taps_ : taps_;
    glEnable(GL_FRAMEBUFFER_SRGB); // of effect on 8-bit targets alone
    const bool from_matte = source_ == unblurred_ && !unblurred_has_depth_;
    pass(taps, from_matte ? taps.from_matte : taps.from_depth, half_target_, *source_, sigma_mm, before_mm);

    const std::size_t target = on_the_fly ? 0 : next_;
    next_ = target + 1;
    const glm::vec3 share = add_weight(weight);
    taps.second.set("share", sum_started_ ? glm::vec3(1) : share);
    taps.second.set("carried_share", sum_started_ ? glm::vec3(0) : 1.0f - share);
    unblurred_->bind(4);
    if (sum_started_) {
        glEnablei(GL_BLEND, 1);
        glBlendFunci(1, GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR);
        glBlendColor(share.r, share.g, share.b, 1);
    }
    pass(taps, taps.second, targets_[target], half_blurred_, sigma_mm, before_mm);
    glDisablei(GL_BLEND, 1);
    glDisable(GL_FRAMEBUFFER_SRGB);
    sum_started_ = on_the_fly;
    source_ = &blurred_[target];
}

const gl::Texture& ScreenBlur::sum() {
    if (method_.accumulation == Accumulation::weighted_sum) {
        std::vector<glm::vec3> weights;
        for (std::size_t i = 0; i < kept_weights_.size(); ++i) {
            weights.push_back(kept_weights_[i] / glm::max(weight_, glm::vec3(1e-30f)));
            (i == 0 ? *unblurred_ : blurred_[i - 1]).bind(static_cast<GLuint>(i));
        }
        weigh_.use();
        weigh_.set("weights", weights);
        weigh_.set("count", static_cast<int>(next_ + 1));
        begin_rect(sum_target_, surface_.geometry().rect);
        draw_screen();
        end_rect();
        return sum_;
    }
    return sum_started_ ? sum_ : *unblurred_;
}

const gl::Framebuffer& ScreenBlur::sum_target() {
    if (method_.accumulation == Accumulation::weighted_sum) {
        sum();
    } else if (!sum_started_) {
        keep_unblurred();
    }
    return sum_target_;
}

} // namespace renderer::passes
