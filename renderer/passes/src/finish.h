// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <memory>

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "depth_of_field.h"
#include "lit_frame.h"

namespace renderer::passes {

/// From scattered light to the finished image: compositing, bloom, output transform, read back.
class Finish {
public:
    Finish(int width, int height, const Look& look);
    void composite(const gl::Texture& scattered, const LitFrame& lit);
    bool has_depth_of_field() const { return look_.aperture_mm > 0; }
    /// Blur what the lens leaves unsharp.
    void depth_of_field(const LitFrame& lit, const scene::Camera& camera);
    bool blooms() const { return look_.bloom_strength > 0 && look_.bloom_sigma_px > 0; }
    void bloom();
    /// Encode; `with_linear` for the linear image, too.
    void output(bool with_linear);
    /// Encode a frame that shows nothing but the background.
    void output_background(bool with_linear);
    /// What was encoded last.
    Frame read(bool with_linear) const;

private:
    PixelRect bloom_rect() const;

    Look look_;
    glm::vec3 level_{1};  ///< of the light in the frame that was composed last
    PixelRect rect_;      ///< nothing of it outside
    PixelRect half_rect_; ///< nothing of the bloom outside
    PixelRect shown_;     ///< what of it the lens spreads the light over; `rect_` where all is sharp
    std::unique_ptr<DepthOfField> depth_of_field_;
    const gl::Texture* image_; ///< `color_`, or what the lens makes of it
    gl::Program composite_, halve_, bloom_, output_;
    gl::Texture color_, half_, half_blurred_, srgb_, linear_;
    gl::Framebuffer color_target_, half_target_, half_blurred_target_, srgb_target_, both_target_;
};

} // namespace renderer::passes
