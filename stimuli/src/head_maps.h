// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>
#include <renderer/scene/model.h>
#include <tbb/parallel_for.h>

#include "head_person.h"
#include "head_surface.h"

namespace stimuli::head {

constexpr int map_size = 2048; ///< texels along u and along v

/// Where each texel's centre lies on the head, and how it stretches there.
class Atlas {
public:
    explicit Atlas(const Surface& surface);

    const glm::vec3& place_mm(int x, int y) const { return places_[index(x, y)]; }
    /// Steps in millimetres to the next texel along u and along v (u wraps around).
    glm::vec3 along_u(int x, int y) const { return 0.5F * (place_mm(x + 1, y) - place_mm(x - 1, y)); }
    glm::vec3 along_v(int x, int y) const;
    /// The longer side of a texel, mm: detail finer than twice this cannot be shown.
    float texel_mm(int x, int y) const {
        return std::max(glm::length(along_u(x, y)), glm::length(along_v(x, y)));
    }

    /// Position of a texel in an array of map_size rows; x wraps around, y is kept inside.
    static std::size_t index(int x, int y);

private:
    std::vector<glm::vec3> places_;
};

using Texel = std::array<std::uint8_t, 3>;
using TexelWithAlpha = std::array<std::uint8_t, 4>;

/// A map whose texels are what `texel_at(x, y)` says; several rows are made at once.
template <typename TexelAt>
renderer::scene::ImagePtr filled_map(const TexelAt& texel_at) {
    constexpr std::size_t channels = std::tuple_size_v<decltype(texel_at(0, 0))>;
    auto image = std::make_shared<renderer::scene::Image>();
    *image = {map_size, map_size, static_cast<int>(channels),
              std::vector<std::uint8_t>(channels * map_size * map_size)};
    tbb::parallel_for(0, map_size, [&](int y) {
        for (int x = 0; x < map_size; ++x) {
            const auto texel = texel_at(x, y);
            std::copy(texel.begin(), texel.end(),
                      image->pixels.begin() + static_cast<std::ptrdiff_t>(channels * Atlas::index(x, y)));
        }
    });
    return image;
}

/// Skin colour, sRGB.
renderer::scene::ImagePtr albedo_map(const Person& person, const Atlas& atlas);
/// Pores, fine lines, creases and hairs as tangent-space normals, green up the image, along -v.
renderer::scene::ImagePtr normal_map(const Person& person, const Atlas& atlas);
/// How the surface reflects: perceptual roughness in green, strength in alpha; red and blue are 0.
renderer::scene::ImagePtr reflection_map(const Person& person, const Atlas& atlas);

/// 1 on the red of the lips, 0 off it.
float on_lips(glm::vec3 folded);

} // namespace stimuli::head
