// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/gl/objects.h>
#include <renderer/optics/kernel.h>
#include <renderer/passes/pipeline.h>

#include "lit_frame.h"
#include "shader_library.h"

namespace renderer::passes {

/// Where a camera's pixels lie, at the resolution of a pass.
struct ScreenGeometry {
    float focal_px = 1;
    glm::vec2 middle_px{0};
    int height = 0;
    PixelRect rect{}; ///< no skin outside
    float scale = 1;  ///< pixels of the pass per pixel of the image
};

/// How deep and how tilted the skin is at each pixel, and how wide kernels are there.
class ScreenSurface {
public:
    ScreenSurface(int width, int height);
    void find(const gl::Texture& depth_mm, const ScreenGeometry& geometry);
    /// Bind the map and set the uniforms of screen_metric.glsl.
    void bind(const gl::Program& program, const Stretch& stretch) const;
    const ScreenGeometry& geometry() const { return geometry_; }

private:
    gl::Program program_;
    gl::Texture depth_and_tilt_;
    gl::Framebuffer target_;
    ScreenGeometry geometry_;
    const gl::Texture* depth_mm_ = nullptr;
};

/// optics::tap_ratio for kernels whose taps reach so far, from 0 up to a standard deviation of `end` steps.
struct RatioTable {
    explicit RatioTable(int reach);
    float end;
    gl::Texture texture;
};

/// Blurs the skin by one Gaussian after another, at one resolution.
class ScreenBlur {
public:
    ScreenBlur(int width, int height, const FullMethod& method);

    /// Start a new sum of Gaussians of skin inside the rectangle.
    void begin(const PixelRect& rect);
    /// Blur `source`, a result of this blur or RGB times matte and matte, by a Gaussian. Adds the result
    /// times `share`, and `carried` times `carried_share`, to the sum. The result holds until the call after
    /// the next.
    const gl::Texture& blur(const ScreenSurface& surface, const gl::Texture& source, float sigma_mm,
                            float widest_px, const glm::vec3& share, const gl::Texture& carried,
                            const glm::vec3& carried_share);
    gl::Texture& sum() { return sum_; }
    const gl::Framebuffer& sum_target() const { return sum_target_; }

private:
    /// The programs of both passes for one number of taps.
    struct Taps {
        Taps(int reach, const FullMethod& method);
        gl::Program from_matte, from_depth, second; ///< the first pass by what the source's alpha is
        RatioTable ratios;
    };
    void pass(const Taps& taps, const gl::Program& program, const ScreenSurface& surface,
              const gl::Texture& source, float sigma_mm) const;

    FullMethod method_;
    Taps taps_;
    Taps few_taps_; ///< for Gaussians narrower than a pixel
    gl::Sampler light_sampler_, depth_sampler_;
    gl::Texture half_blurred_, blurred_[2], sum_;
    gl::Framebuffer half_target_, targets_[2], sum_target_;
    PixelRect rect_;
    int next_ = 0;
};

/// Bind a framebuffer and let only the rectangle be drawn until end_rect().
void begin_rect(const gl::Framebuffer& target, const PixelRect& rect);
void end_rect();

/// The defines of screen_metric.glsl.
inline Defines metric_defines(Foreshortening foreshortening) {
    return {{"PUBLISHED_FORESHORTENING", foreshortening == Foreshortening::published ? 1 : 0}};
}

/// The format of the targets that a method blurs into.
GLenum blur_format(const FullMethod& method);

} // namespace renderer::passes
