// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <glm/glm.hpp>

#include <renderer/scene/appearance.h>
#include <renderer/scene/frame.h>

namespace renderer::reference {

/// A picture of the skin: linear light times coverage, coverage. Rows from the bottom up, as in OpenGL, so
/// that halving an odd number of rows leaves out the same ones.
struct Picture {
    int width = 0, height = 0;
    std::vector<glm::vec4> pixels;

    Picture(int width_, int height_)
        : width(width_), height(height_),
          pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), glm::vec4(0)) {}
    glm::vec4& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    const glm::vec4& at(int x, int y) const { return const_cast<Picture*>(this)->at(x, y); }
    /// The nearest pixel of the picture.
    const glm::vec4& clamped(int x, int y) const {
        return at(glm::clamp(x, 0, width - 1), glm::clamp(y, 0, height - 1));
    }
};

/// Bloom, background, exposure and the sRGB transfer function [IEC1999], as halve.frag, bloom_blur.frag and
/// output.frag.
scene::Frame finished(const Picture& picture, const scene::Look& look, bool with_linear);

} // namespace renderer::reference
