// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_maps.h"

#include "head_landmarks.h"

namespace stimuli::head {

Atlas::Atlas(const Surface& surface) {
    places_.reserve(static_cast<std::size_t>(map_size) * map_size);
    for (int y = 0; y < map_size; ++y) {
        const float row = (static_cast<float>(y) + 0.5F) / map_size * static_cast<float>(surface.rows);
        const int j = static_cast<int>(row);
        for (int x = 0; x < map_size; ++x) {
            const float column =
                (static_cast<float>(x) + 0.5F) / map_size * static_cast<float>(surface.columns);
            const int i = static_cast<int>(column);
            const float right = column - static_cast<float>(i), down = row - static_cast<float>(j);
            places_.push_back(glm::mix(glm::mix(surface.at(i, j), surface.at(i + 1, j), right),
                                       glm::mix(surface.at(i, j + 1), surface.at(i + 1, j + 1), right),
                                       down));
        }
    }
}

glm::vec3 Atlas::along_v(int x, int y) const {
    const int above = std::max(y - 1, 0), below = std::min(y + 1, map_size - 1);
    return (place_mm(x, below) - place_mm(x, above)) / static_cast<float>(below - above);
}

std::size_t Atlas::index(int x, int y) {
    const int column = (x % map_size + map_size) % map_size, row = std::clamp(y, 0, map_size - 1);
    return static_cast<std::size_t>(row) * map_size + static_cast<std::size_t>(column);
}

float on_lips(glm::vec3 folded) {
    if (folded.z < 50) {
        return 0;
    }
    const float within_top = lip_top_y(folded.x) - folded.y,
                within_bottom = folded.y - lip_bottom_y(folded.x);
    const float within_side = mouth_half_width - 0.5F - folded.x;
    return smooth_step(-1.3F, 2.0F, within_top) * smooth_step(-1.6F, 3.0F, within_bottom) *
           smooth_step(-1.5F, 5.5F, within_side);
}

} // namespace stimuli::head
