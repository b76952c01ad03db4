// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_maps.h"

#include <cstdint>
#include <utility>

#include <support/random.h>

#include "head_hair.h"
#include "head_landmarks.h"
#include "head_lines.h"
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
    return rest + front * std::min(nose + cheek + forehead + chin, 1.0F) * (1 - 0.8F * lids);
}

/// Dent the height map where pores open.
void add_pores(std::vector<float>& height_mm, const Person& person, const Atlas& atlas) {
    support::Generator generator("head pores", person.seed);
    constexpr int candidates = 500000;
    constexpr double most_per_mm2 = 1.7;
    constexpr double texels = static_cast<double>(map_size) * map_size;
    for (int candidate = 0; candidate < candidates; ++candidate) {
        const int x = static_cast<int>(generator.below(map_size)),
                  y = static_cast<int>(generator.below(map_size));
        const double chance = generator.uniform();
        const float size = static_cast<float>(generator.uniform());
        const float radius_mm = 0.14F + 0.20F * size * size;
        const float depth_mm = (0.35F + 0.65F * static_cast<float>(generator.uniform())) * 0.34F * radius_mm;

        // Keep as many candidates as the skin below this texel has pores.
        const glm::vec3 u = atlas.along_u(x, y), v = atlas.along_v(x, y);
        const double area_mm2 = static_cast<double>(glm::length(glm::cross(u, v)));
        const double density = static_cast<double>(pore_density(person.fold(atlas.place_mm(x, y))));
        if (chance * candidates > most_per_mm2 * density * area_mm2 * texels) {
            continue;
        }
        if (atlas.texel_mm(x, y) > 1.5F * radius_mm) {
            continue;
        }
        const float uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
        constexpr int reach = 6;
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

/// Relief of the skin in mm over the surface, without pores, as far as texels of the given size can show it.
float relief_mm(const Person& person, const Noise& noise, const Hairs& hairs, glm::vec3 place,
                float texel_mm) {
    const glm::vec3 p = person.fold(place);
    const float lips = on_lips(p);
    const float face = (0.6F + 0.4F * smooth_step(20, 60, p.z)) * (1 - 0.6F * lips) *
                       (1 - 0.6F * std::exp(-square((p.x - 31) / 15) - square((p.y + 1) / 8)));

    // Skin is uneven at all sizes, and fine furrows, drawn out along its lines of tension, cut it into small
    // fields.
    float uneven = 0;
    for (const auto& [size_mm, height_mm] :
         {std::pair{6.0F, 0.09F}, {3.1F, 0.050F}, {1.5F, 0.042F}, {0.75F, 0.026F}, {0.42F, 0.012F}}) {
        const float shown = smooth_step(0.5F * size_mm, 0.25F * size_mm, texel_mm);
        uneven += shown > 0 ? shown * height_mm * noise(place / size_mm + glm::vec3(9 * size_mm)) : 0;
    }
    const float furrowed = 0.011F + 0.010F * person.wrinkled;
    for (const float size_mm : {1.5F, 1.0F, 0.62F}) {
        const float shown = smooth_step(0.5F * size_mm, 0.25F * size_mm, texel_mm);
        const glm::vec3 drawn_out(0.72F, 1.25F, 1);
        uneven -= shown > 0 ? shown * furrowed * std::min(size_mm, 1.2F) *
                                  bell(noise(place * drawn_out / size_mm + glm::vec3(40 * size_mm)), 0.13F)
                            : 0;
    }
    const float hair = 0.07F * hairs.cover(p, place.x < 0 ? -1.0F : 1.0F, texel_mm).share;
    return face * uneven - lines_mm(person, noise, p, place) + hair;
}

/// The normals of a height map, from differences over sheared texels: slopes along the tangent (+u) and the
/// bitangent
/// (+v, across it).
renderer::scene::ImagePtr normals_of(const std::vector<float>& height_mm, const Atlas& atlas) {
    return filled_map([&](int x, int y) -> Texel {
        const glm::vec3 u = atlas.along_u(x, y), v = atlas.along_v(x, y);
        const float step_u = std::max(glm::length(u), 1e-3F), shear = glm::dot(u, v) / step_u;
        const float step_v = std::sqrt(std::max(glm::dot(v, v) - shear * shear, 1e-6F));
        const auto at = [&](int dx, int dy) { return height_mm[Atlas::index(x + dx, y + dy)]; };
        const float slope_u = 0.5F * (at(1, 0) - at(-1, 0)) / step_u;
        const float slope_v =
            (0.5F * (at(0, 1) - at(0, -1)) - shear / step_u * 0.5F * (at(1, 0) - at(-1, 0))) / step_v;
        const glm::vec3 normal = glm::normalize(glm::vec3(-slope_u, slope_v, 1));
        Texel texel{};
        for (int k = 0; k < 3; ++k) {
            texel[static_cast<std::size_t>(k)] =
                static_cast<std::uint8_t>(std::lround((normal[k] * 0.5F + 0.5F) * 255));
        }
        return texel;
    });
}

} // namespace

renderer::scene::ImagePtr normal_map(const Person& person, const Atlas& atlas) {
    const Noise noise("head relief", person.seed);
    const Hairs hairs(person);
    std::vector<float> height_mm(static_cast<std::size_t>(map_size) * map_size);
    tbb::parallel_for(0, map_size, [&](int y) {
        for (int x = 0; x < map_size; ++x) {
            height_mm[Atlas::index(x, y)] =
                relief_mm(person, noise, hairs, atlas.place_mm(x, y), atlas.texel_mm(x, y));
        }
    });
    add_pores(height_mm, person, atlas);
    return normals_of(height_mm, atlas);
}

} // namespace stimuli::head
