// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "textures.h"

#include <cmath>

#include <renderer/optics/color.h>

namespace renderer::reference {
namespace {

/// The two texels beside a coordinate in texels, and how near it is to the second.
struct Neighbours {
    int first = 0, second = 0;
    float share = 0;
};

Neighbours neighbours(float coordinate, int size) {
    // Fold into [0, 1) before scaling, so that no coordinate is too large.
    const float folded = std::isfinite(coordinate) ? coordinate - std::floor(coordinate) : 0.0f;
    const float place = folded * static_cast<float>(size) - 0.5f;
    const float floor = std::floor(place);
    const int first = static_cast<int>(floor);
    return {(first + size) % size, (first + 1) % size, place - floor};
}

} // namespace

Texture::Texture(const scene::ImagePtr& image, bool srgb, const glm::vec4& constant)
    : image_(image.get()), constant_(constant) {
    for (int i = 0; i < 256; ++i) {
        decoded_.push_back(static_cast<float>(srgb ? optics::linear_from_srgb(i / 255.0) : i / 255.0));
    }
}

glm::vec4 Texture::texel(int x, int y) const {
    const auto channels = static_cast<std::size_t>(image_->channels);
    const std::size_t i = channels * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_->width) +
                                      static_cast<std::size_t>(x));
    const std::uint8_t* p = &image_->pixels[i];
    return {decoded_[p[0]], decoded_[p[1]], decoded_[p[2]],
            channels == 4 ? static_cast<float>(p[3]) / 255 : 1.0f};
}

glm::vec4 Texture::at(const glm::vec2& uv) const {
    if (image_ == nullptr) {
        return constant_;
    }
    const Neighbours x = neighbours(uv.x, image_->width);
    const Neighbours y = neighbours(uv.y, image_->height);
    return glm::mix(glm::mix(texel(x.first, y.first), texel(x.second, y.first), x.share),
                    glm::mix(texel(x.first, y.second), texel(x.second, y.second), x.share), y.share);
}

} // namespace renderer::reference
