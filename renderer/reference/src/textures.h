// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <glm/glm.hpp>

#include <renderer/scene/model.h>

namespace renderer::reference {

/// An image as a bilinear, repeating texture without mip levels. A missing image is a constant.
class Texture {
public:
    /// `srgb`: decode colours to linear Rec. 709. The image outlives the texture.
    Texture(const scene::ImagePtr& image, bool srgb, const glm::vec4& constant);

    bool is_constant() const { return image_ == nullptr; }
    /// `uv`: (0, 0) is the outer corner of the first texel of the first row. Alpha is 1 where the image has
    /// none.
    glm::vec4 at(const glm::vec2& uv) const;

private:
    glm::vec4 texel(int x, int y) const;

    const scene::Image* image_;
    std::vector<float> decoded_; ///< of the 256 values of a colour channel
    glm::vec4 constant_;
};

} // namespace renderer::reference
