// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <renderer/gl/objects.h>
#include <renderer/optics/kernel.h>
#include <renderer/passes/pipeline.h>

#include "screen_surface.h"
#include "shader_library.h"

namespace renderer::passes {

/// optics::tap_ratio for kernels whose taps reach so far, from 0 up to a standard deviation of `end` steps.
struct RatioTable {
    explicit RatioTable(int reach);
    float end;
    gl::Texture texture;
};

/// Blurs the skin by one Gaussian after another, at one resolution, and sums them up.
class ScreenBlur {
public:
    /// `surface` outlives it. `gaussians`: how many at most, where all are kept.
    ScreenBlur(const ScreenSurface& surface, int width, int height, const FullMethod& method,
               std::size_t gaussians, bool early_test);

    /// Start anew in the surface found last, with light times matte whose alpha is the matte or, if it comes
    /// from a blur that carries it, the depth.
    void begin(const gl::Texture& unblurred, bool has_depth = false);
    /// Whether alpha is the depth in what a blur by this method makes.
    static bool carries_depth(const FullMethod& method);
    /// Blur further by a Gaussian, where the skin is nearer than `before_mm` (0: everywhere, as has to be
    /// where all are kept), and add the result to the sum with this weight. `widest_px` is its width where
    /// the skin is nearest.
    void blur(float sigma_mm, float widest_px, const glm::vec3& weight, float before_mm);
    /// Leave a Gaussian out: what the sum holds so far, or the unblurred light, stands for it.
    void skip(const glm::vec3& weight) { add_weight(weight); }
    /// What is blurred so far.
    const gl::Texture& blurred() const { return *source_; }
    /// The weighted sum, divided by the sum of weights.
    const gl::Texture& sum();
    /// Sum of the weights so far.
    const glm::vec3& weight() const { return weight_; }
    /// Where to blend more into the sum, with `share` of it: set it as the blend colour.
    const gl::Framebuffer& sum_target();
    const gl::Texture& blended() const { return sum_; }
    glm::vec3 add_weight(const glm::vec3& weight);

private:
    /// The programs of both passes for one number of taps.
    struct Taps {
        Taps(int reach, const FullMethod& method, bool early_test);
        gl::Program from_matte, from_depth, second; ///< the first pass by what the source's alpha is
        RatioTable ratios;
    };
    void pass(const Taps& taps, const gl::Program& program, const gl::Framebuffer& target,
              const gl::Texture& source, float sigma_mm, float before_mm);
    void keep_unblurred();
    void clear_blurred();

    const ScreenSurface& surface_;
    FullMethod method_;
    bool early_test_;
    Taps taps_;
    Taps few_taps_; ///< for Gaussians narrower than a pixel
    gl::Program copy_, weigh_;
    gl::Sampler light_sampler_;
    gl::Texture half_blurred_, sum_;
    std::vector<gl::Texture> blurred_; ///< one; or one for each Gaussian, where all are kept
    std::vector<gl::Framebuffer> targets_;
    gl::Framebuffer half_target_, sum_target_;
    PixelRect rect_; ///< nothing but 0 outside of it
    // Of the frame:
    const gl::Texture* unblurred_ = nullptr;
    bool unblurred_has_depth_ = false;
    const gl::Texture* source_ = nullptr;
    std::size_t next_ = 0;
    bool sum_started_ = false;
    glm::vec3 weight_{0};
    std::vector<glm::vec3> kept_weights_; ///< of the unblurred light and of blurred_
};

/// The format of the targets that a method blurs into.
GLenum blur_format(const FullMethod& method);

} // namespace renderer::passes
