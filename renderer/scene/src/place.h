// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <cstring>

#include <glm/glm.hpp>

namespace renderer::scene {

/// Hash of a place, for finding vertices that share it exactly.
struct PlaceHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::size_t hash = 0;
        for (int i = 0; i < 3; ++i) {
            std::uint32_t bits = 0;
            const float value = p[i] == 0 ? 0.0f : p[i]; // -0 and 0 are one place
            std::memcpy(&bits, &value, sizeof bits);
            hash = hash * 1000003u ^ bits;
        }
        return hash;
    }
};

} // namespace renderer::scene
