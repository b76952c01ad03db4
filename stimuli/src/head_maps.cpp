// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_maps.h"

#include <glm/gtc/constants.hpp>

#include "head_landmarks.h"
#include "head_noise.h"

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

float brow_hair(const Noise& noise, glm::vec3 folded, glm::vec3 place_mm) {
    if (folded.x < 5 || folded.x > 62 || folded.y < 0 || folded.y > 32 || folded.z < 30) {
        return 0;
    }
    // The brow is a band, full from its inner end to the arch and thinning outwards.
    const float s = (folded.x - 9) / 48, offset = folded.y - brow_y(folded.x);
    const float half_height = 5.6F - 2.8F * std::clamp(s, 0.0F, 1.0F);
    const float band =
        bell(offset, half_height) * smooth_step(-0.06F, 0.16F, s) * smooth_step(1.04F, 0.6F, s);

    // Hairs stand up at the inner end and lie down along the brow farther out.
    float hair = 0;
    for (const float turn : {-0.25F, 0.2F}) {
        const float angle = std::clamp(1.15F - 1.5F * s + turn, -0.35F, 1.3F);
        const float along = std::cos(angle) * folded.x + std::sin(angle) * folded.y;
        const float across = std::cos(angle) * folded.y - std::sin(angle) * folded.x;
        const float side = place_mm.x < 0 ? 40.0F : 0.0F;
        const float strand = noise({across * 1.45F, along * 0.16F + side, turn * 50});
        hair = std::max(hair, smooth_step(0.0F, 0.45F, strand + 0.6F * band - 0.28F));
    }
    return std::min(band * (0.25F + 0.85F * hair), 1.0F);
}

float lashes(const Noise& noise, glm::vec3 folded, glm::vec3 place_mm) {
    const float s = along_eye(folded.x);
    if (s < -0.05F || s > 1.12F || folded.z < 40) {
        return 0;
    }
    // A dark seam where the lids meet, and hairs that hang from it and lean outwards.
    const float below = lid_line_y(folded.x) - folded.y;
    const float present = smooth_step(-0.02F, 0.12F, s) * smooth_step(1.1F, 0.95F, s);
    const float seam = bell(below - 0.1F, 0.6F);
    constexpr float lash_spacing_mm = 1.1F;
    const float length = 1.5F + 3.0F * smooth_step(0.05F, 0.75F, s);
    const float lean = folded.x - (s - 0.35F) * 0.8F * std::max(below, 0.0F);
    const float uneven = noise({lean * 0.5F, place_mm.x < 0 ? 70.5F : 3.5F, 0.5F});
    const float strand = bell(std::sin(glm::pi<float>() * (lean / lash_spacing_mm + 0.9F * uneven)), 0.5F);
    const float hair = strand * smooth_step(-0.3F, 0.3F, below) * smooth_step(length, 0.3F * length, below);
    return present * std::max(seam, 0.9F * hair);
}

float on_lips(glm::vec3 folded) {
    if (folded.z < 50) {
        return 0;
    }
    const float within_top = lip_top_y(folded.x) - folded.y,
                within_bottom = folded.y - lip_bottom_y(folded.x);
    const float within_side = mouth_half_width - 0.5F - folded.x;
    return smooth_step(-0.9F, 0.9F, within_top) * smooth_step(-1.2F, 1.0F, within_bottom) *
           smooth_step(-0.8F, 1.2F, within_side);
}

} // namespace stimuli::head
