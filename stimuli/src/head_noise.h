// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <glm/glm.hpp>

namespace stimuli::head {

/// Gradient noise over space: smooth, about -1 to 1, 0 on average, features about one unit across.
/// [Perlin2002]
class Noise {
public:
    /// The same name and seed give the same noise.
    explicit Noise(std::string_view name, std::uint64_t seed = 0);

    float operator()(glm::vec3 place) const;
    /// Octaves of halving size and height, as many as asked for.
    float octaves(glm::vec3 place, int count) const;

private:
    std::array<std::uint8_t, 512> shuffled_{};
};

} // namespace stimuli::head
