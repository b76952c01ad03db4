// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "lit_frame.h"

namespace renderer::passes {

/// From scattered light to the finished image: compositing, bloom, output transform, read back.
class Finish {
public:
    Finish(int width, int height, const Look& look);
    void composite(const gl::Texture& scattered, const LitFrame& lit);
    void bloom();
    /// Encode and read back; `with_linear` fills Frame::linear, too.
    Frame output(bool with_linear);

private:
    Look look_;
    glm::vec3 level_{1}; ///< of the light in the frame that was composed last
    gl::Program composite_, halve_, bloom_, output_;
    gl::Texture color_, half_, half_blurred_, srgb_, linear_;
    gl::Framebuffer color_target_, half_target_, half_blurred_target_, srgb_target_, both_target_;
};

} // namespace renderer::passes
