// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_maps.h"

#include <cstdint>
#include <memory>
#include <utility>

#include <support/random.h>

#include "head_field.h"
#include "head_landmarks.h"
#include "head_noise.h"

namespace stimuli::head {
namespace {

/// How strongly the skin is pored, 0 to 1: most on the nose and beside it, less on forehead and chin.
float pore_density(glm::vec3 p) {
    const float front = smooth_step(20, 60, p.z) * (1 - on_lips(p)) * smooth_step(-125, -108, p.y);
    const float nose = std::exp(-square(p.x / 20) - square((p.y + 32) / 20));
    const float cheek = std::exp(-square((p.x - 32) / 22) - square((p.y + 36) / 24));
    const float forehead = 0.5F * std::exp(-square(p.x / 50) - square((p.y - 40) / 30));
    const float chin = 0.5F * std::exp(-square(p.x / 28) - square((p.y + 98) / 18));
    const float lids = std::exp(-square((p.x - 32) / 17) - square((p.y + 1) / 11));
    const float rest = 0.12F * smooth_step(71, 66, p.x);
    return rest + front * std::min(nose + cheek + forehead + chin, 1.0F) * (1 - 0.5F * lids);
}

/// Dent the height map where pores open.
void add_pores(std::vector<float>& height_mm, const Atlas& atlas) {
    support::Generator generator("head pores", 0);
    constexpr int candidates = 400000;
    constexpr double most_per_mm2 = 1.3;
    constexpr double texels = static_cast<double>(map_size) * map_size;
    for (int candidate = 0; candidate < candidates; ++candidate) {
        const int x = static_cast<int>(generator.below(map_size)),
                  y = static_cast<int>(generator.below(map_size));
        const double chance = generator.uniform();
        const float radius_mm = 0.20F + 0.18F * static_cast<float>(generator.uniform());
        const float depth_mm = (0.35F + 0.65F * static_cast<float>(generator.uniform())) * 0.36F * radius_mm;

        // Keep as many candidates as the skin below this texel has pores.
        const glm::vec3 u = atlas.along_u(x, y), v = atlas.along_v(x, y);
        const double area_mm2 = static_cast<double>(glm::length(glm::cross(u, v)));
        const double density = static_cast<double>(pore_density(fold(atlas.place_mm(x, y))));
        if (chance * candidates > most_per_mm2 * density * area_mm2 * texels) {
            continue;
        }
        if (atlas.texel_mm(x, y) > 2 * radius_mm) {
            continue;
        }
        const float uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
        constexpr int reach = 4;
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                const auto a = static_cast<float>(dx), b = static_cast<float>(dy);
                const float distance2 = (uu * a * a + 2 * uv * a * b + vv * b * b) / square(radius_mm);
                if (distance2 < 6 && y + dy >= 0 && y + dy < map_size) {
                    height_mm[Atlas::index(x + dx, y + dy)] -= depth_mm * std::exp(-distance2);
                }
            }
        }
    }
}

/// A valley along the zeros of a noise: 1 in its middle, 0 beyond `width` of the noise's values.
float valley(float noise, float width) { return bell(noise, width); }

/// Lines that expression leaves: forehead, outer corners of the eyes, lids, below the eyes, lips.
float creases_mm(const Noise& noise, glm::vec3 p, glm::vec3 place) {
    if (p.z < 35 || p.y > 80 || p.y < -125) {
        return 0;
    }
    float depth = 0;
    const float forehead = std::exp(-square(p.x / 38) - square((p.y - 44) / 17));
    depth +=
        0.09F * forehead * valley(noise({p.x / 60, p.y / 7.5F + 0.25F * noise(place / 18.0F), 3.3F}), 0.10F);

    // Around the eye, lines follow the lids; at its outer corner they fan out.
    const float s = along_eye(p.x);
    const float lids =
        std::exp(-square((p.x - 32) / 15)) * smooth_step(-17, -7, p.y) * smooth_step(11, 5, p.y);
    depth += 0.045F * lids *
             valley(noise({p.x / 14, (p.y + 4.6F * arch(s)) / 1.5F, place.x < 0 ? 9.5F : 1.5F}), 0.14F);
    const glm::vec2 from_corner(p.x - eye_outer_x + 4, p.y + 1.5F);
    const float fan = bell(glm::length(from_corner) - 13, 8) * smooth_step(0, 8, from_corner.x);
    const float angle = std::atan2(from_corner.y, from_corner.x);
    depth += 0.12F * fan *
             valley(noise({angle * 5, glm::length(from_corner) / 15, place.x < 0 ? 4.5F : 2.5F}), 0.12F);
    const float present = smooth_step(-0.05F, 0.1F, s) * smooth_step(1.12F, 0.95F, s);
    depth +=
        present * (0.10F * bell(p.y - lid_fold_y(p.x), 0.9F) + 0.45F * bell(p.y - lid_line_y(p.x), 0.4F));

    // Lips are grooved from edge to edge and parted by a sharp line.
    const float lips = on_lips(p);
    depth += 0.15F * lips * valley(noise({p.x * 0.62F, p.y * 0.09F, place.x < 0 ? 7.7F : 0.7F}), 0.16F);
    depth += 0.4F * smooth_step(1.05F, 0.95F, p.x / mouth_half_width) * bell(p.y - lip_line_y(p.x), 0.45F) *
             smooth_step(50, 60, p.z);
    return -depth;
}

/// Relief of the skin in mm over the surface, without pores, as far as texels of the given size can show it.
float relief_mm(const Noise& noise, glm::vec3 place, float texel_mm) {
    const glm::vec3 p = fold(place);
    const float lips = on_lips(p);
    const float face = (0.6F + 0.4F * smooth_step(20, 60, p.z)) * (1 - 0.6F * lips);

    // Skin is uneven at all sizes, and fine furrows cut it into small fields.
    float uneven = 0;
    for (const auto& [size_mm, height_mm] : {std::pair{3.4F, 0.105F}, {1.5F, 0.068F}, {0.75F, 0.032F}}) {
        const float shown = smooth_step(0.5F * size_mm, 0.25F * size_mm, texel_mm);
        uneven += shown > 0 ? shown * height_mm * noise(place / size_mm + glm::vec3(9 * size_mm)) : 0;
    }
    for (const float size_mm : {1.25F, 0.9F}) {
        const float shown = smooth_step(0.5F * size_mm, 0.25F * size_mm, texel_mm);
        uneven -=
            shown > 0 ? shown * 0.038F * valley(noise(place / size_mm + glm::vec3(40 * size_mm)), 0.13F) : 0;
    }
    const float hair = 0.10F * brow_hair(noise, p, place) + 0.12F * lashes(noise, p, place);
    return face * uneven + creases_mm(noise, p, place) + hair;
}

} // namespace

renderer::scene::ImagePtr normal_map(const Atlas& atlas) {
    const Noise noise("head relief");
    std::vector<float> height_mm;
    height_mm.reserve(static_cast<std::size_t>(map_size) * map_size);
    for (int y = 0; y < map_size; ++y) {
        for (int x = 0; x < map_size; ++x) {
            height_mm.push_back(relief_mm(noise, atlas.place_mm(x, y), atlas.texel_mm(x, y)));
        }
    }
    add_pores(height_mm, atlas);

    auto image = std::make_shared<renderer::scene::Image>();
    *image = {map_size, map_size, 3, {}};
    image->pixels.reserve(height_mm.size() * 3);
    for (int y = 0; y < map_size; ++y) {
        for (int x = 0; x < map_size; ++x) {
            // Slopes along the tangent (+u) and the bitangent (+v, across it), from differences over sheared
            // texels.
            const glm::vec3 u = atlas.along_u(x, y), v = atlas.along_v(x, y);
            const float step_u = std::max(glm::length(u), 1e-3F), shear = glm::dot(u, v) / step_u;
            const float step_v = std::sqrt(std::max(glm::dot(v, v) - shear * shear, 1e-6F));
            const auto at = [&](int dx, int dy) { return height_mm[Atlas::index(x + dx, y + dy)]; };
            const float slope_u = 0.5F * (at(1, 0) - at(-1, 0)) / step_u;
            const float slope_v = (0.5F * (at(0, 1) - at(0, -1)) - shear * slope_u) / step_v;
            const glm::vec3 normal = glm::normalize(glm::vec3(-slope_u, slope_v, 1));
            for (int k = 0; k < 3; ++k) {
                image->pixels.push_back(
                    static_cast<std::uint8_t>(std::lround((normal[k] * 0.5F + 0.5F) * 255)));
            }
        }
    }
    return image;
}

} // namespace stimuli::head
