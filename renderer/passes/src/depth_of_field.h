// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/gl/objects.h>
#include <renderer/passes/pipeline.h>

#include "lit_frame.h"

namespace renderer::passes {

/// The blur of a thin lens: each pixel gathers, from a disk, what spreads over it.
class DepthOfField {
public:
    DepthOfField(int width, int height, const Look& look);
    /// `color`: light times coverage, coverage; nothing outside of the lit frame's rectangle.
    const gl::Texture& blur(const gl::Texture& color, const LitFrame& lit, const scene::Camera& camera);
    /// Nothing of the last result outside.
    const PixelRect& rect() const { return rect_; }

private:
    float aperture_mm_, focus_mm_;
    gl::Program program_;
    gl::Texture blurred_;
    gl::Framebuffer target_;
    PixelRect rect_;
};

} // namespace renderer::passes
