// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_maps.h"

#include <array>
#include <cstdint>
#include <memory>

#include "head_field.h"
#include "head_landmarks.h"
#include "head_noise.h"

namespace stimuli::head {
namespace {

using renderer::scene::Image;
using renderer::scene::ImagePtr;

/// What colours a place, beyond the paler skin everywhere: optical densities relative to the vectors below.
struct Pigment {
    float melanin = 0, blood = 0;
};

// Colour of skin without extra pigment (linear Rec. 709), and how strongly melanin and blood absorb red,
// green and blue: melanin more towards blue, blood little in red and most in green.
constexpr glm::vec3 pale_skin{0.62F, 0.395F, 0.295F};
constexpr glm::vec3 melanin_absorption{0.42F, 0.72F, 1.0F};
constexpr glm::vec3 blood_absorption{0.14F, 0.80F, 0.66F};
constexpr glm::vec3 hair_colour{0.045F, 0.024F, 0.014F};

/// A patch that is redder or browner than its surroundings.
struct Patch {
    glm::vec3 centre, spread; ///< mm
    Pigment pigment;
};

constexpr std::array<Patch, 11> patches{{
    {{0, -38, 110}, {15, 13, 18}, {0.00F, 0.30F}},  // tip of the nose
    {{13, -44, 95}, {7, 9, 12}, {0.02F, 0.26F}},    // its wings
    {{43, -34, 74}, {19, 16, 30}, {0.00F, 0.30F}},  // cheeks
    {{30, -20, 82}, {22, 8, 20}, {0.03F, 0.14F}},   // below the eyes
    {{32, 0, 80}, {19, 12, 20}, {0.09F, 0.16F}},    // lids and sockets
    {{17, -3, 78}, {6, 8, 14}, {0.13F, 0.16F}},     // inner corners
    {{0, -104, 88}, {16, 12, 20}, {0.00F, 0.14F}},  // chin
    {{24, 52, 86}, {34, 22, 40}, {-0.05F, 0.02F}},  // forehead
    {{90, -17, -30}, {22, 40, 22}, {0.00F, 0.34F}}, // ears
    {{28, -72, 84}, {6, 6, 14}, {0.05F, 0.12F}},    // corners of the mouth
    {{31, -3, 83}, {16, 8, 14}, {0.15F, 0.10F}},    // closed lids
}};

float patch_weight(const Patch& patch, glm::vec3 p) {
    const glm::vec3 rel = (p - patch.centre) / patch.spread;
    return std::exp(-glm::dot(rel, rel));
}

/// Height of the hairline over z, from the nape over the ears to the forehead.
float hairline_y(float z) {
    constexpr std::array<glm::vec2, 8> line{
        {{-95, -62}, {-70, -58}, {-45, -25}, {-24, 16}, {2, 14}, {14, 38}, {52, 58}, {86, 70}}};
    std::size_t i = 0;
    while (i + 2 < line.size() && z > line[i + 1].x) {
        ++i;
    }
    const float t = std::clamp((z - line[i].x) / (line[i + 1].x - line[i].x), 0.0F, 1.0F);
    return glm::mix(line[i].y, line[i + 1].y, t);
}

/// Shaven hair, in fine dots, over 0 (none) to 1: the scalp, and a little beard.
float stubble_at(const Noise& noise, glm::vec3 p, glm::vec3 place) {
    const float ragged = 5 * noise(place / 9.0F);
    const float scalp = smooth_step(-9, 9, p.y - hairline_y(p.z) + ragged);
    const float jaw = smooth_step(
        -44, -72, p.y + 0.45F * std::max(p.x - 30, 0.0F) * smooth_step(60, 20, p.z) + 0.5F * ragged);
    const float front = smooth_step(-5, 25, p.z) * smooth_step(-150, -122, p.y) * smooth_step(104, 98, p.z);
    const float beard = 0.55F * jaw * front * (1 - on_lips(p)) * smooth_step(-52, -57, p.y);
    const float all = std::max(scalp, beard);
    return all > 0 ? all * (0.20F + 0.18F * noise(place / 0.75F)) : 0;
}

/// Small brown spots, many over the nose and the cheeks.
float freckles(const Noise& noise, glm::vec3 p, glm::vec3 place) {
    const float where = std::exp(-square(p.x / 52) - square((p.y + 24) / 26)) * smooth_step(30, 60, p.z);
    if (where < 0.02F) {
        return 0;
    }
    const float spots = noise(place / 1.5F + glm::vec3(31)) + 0.5F * noise(place / 9.0F);
    return where * smooth_step(0.48F, 0.8F, spots);
}

Pigment pigment_at(const Noise& noise, glm::vec3 p, glm::vec3 place) {
    Pigment sum{0.10F, 0.10F};
    for (const Patch& patch : patches) {
        const float weight = patch_weight(patch, p);
        sum.melanin += weight * patch.pigment.melanin;
        sum.blood += weight * patch.pigment.blood;
    }
    // Mottle the skin, coarsely by its blood and finely by both.
    sum.blood += 0.09F * noise.octaves(place / 17.0F, 2) + 0.05F * noise.octaves(place / 2.2F, 2);
    sum.melanin += 0.05F * noise.octaves(place / 23.0F + glm::vec3(50), 2) + 0.035F * noise(place / 1.3F);
    sum.melanin += 0.34F * freckles(noise, p, place);

    const float lips = on_lips(p);
    if (lips > 0) {
        sum.blood += lips * (0.62F + 0.10F * noise(place * glm::vec3(0.7F, 0.15F, 0.3F)));
        sum.melanin += 0.12F * lips;
    }
    return sum;
}

/// Linear colour of the skin with its hairs, dark in the nostrils and between the lips, where little light
/// leaves.
glm::vec3 colour_at(const Noise& noise, glm::vec3 place) {
    const glm::vec3 p = fold(place);
    const Pigment pigment = pigment_at(noise, p, place);
    const glm::vec3 skin =
        pale_skin * glm::exp(-(pigment.melanin * melanin_absorption + pigment.blood * blood_absorption));
    const float nostril =
        std::exp(-square((p.x - 7.2F) / 3.6F) - square((p.y + 52) / 2.6F) - square((p.z - 99) / 8));
    const float parting = smooth_step(mouth_half_width + 1.5F, mouth_half_width - 4, p.x) *
                          bell(p.y - lip_line_y(p.x), 0.75F) * smooth_step(50, 60, p.z);
    const float shade = (1 - 0.75F * nostril) * (1 - 0.7F * parting);
    const float stubble = stubble_at(noise, p, place);
    const float hair =
        std::max({0.88F * brow_hair(noise, p, place), 0.95F * lashes(noise, p, place), stubble});
    return glm::mix(skin * shade, hair_colour, hair);
}

std::uint8_t srgb_byte(float linear) {
    const float clamped = std::clamp(linear, 0.0F, 1.0F);
    const float encoded =
        clamped <= 0.0031308F ? 12.92F * clamped : 1.055F * std::pow(clamped, 1 / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(encoded * 255));
}

} // namespace

ImagePtr albedo_map(const Atlas& atlas) {
    const Noise noise("head albedo");
    auto image = std::make_shared<Image>(Image{map_size, map_size, 3, {}});
    image->pixels.reserve(static_cast<std::size_t>(map_size) * map_size * 3);
    for (int y = 0; y < map_size; ++y) {
        for (int x = 0; x < map_size; ++x) {
            const glm::vec3 colour = colour_at(noise, atlas.place_mm(x, y));
            for (int k = 0; k < 3; ++k) {
                image->pixels.push_back(srgb_byte(colour[k]));
            }
        }
    }
    return image;
}

ImagePtr roughness_map(const Atlas& atlas) {
    const Noise noise("head roughness");
    auto image = std::make_shared<Image>(Image{map_size, map_size, 3, {}});
    image->pixels.reserve(static_cast<std::size_t>(map_size) * map_size * 3);
    for (int y = 0; y < map_size; ++y) {
        for (int x = 0; x < map_size; ++x) {
            // Nose and forehead are oily, the lips moist, the rest dry.
            const glm::vec3 place = atlas.place_mm(x, y), p = fold(place);
            const float nose =
                std::exp(-square(p.x / 18) - square((p.y + 32) / 22)) * smooth_step(70, 85, p.z);
            const float forehead =
                std::exp(-square(p.x / 42) - square((p.y - 42) / 24)) * smooth_step(40, 70, p.z);
            const float uneven = 0.05F * noise.octaves(place / 4.0F, 2);
            const float roughness = 0.52F - 0.11F * nose - 0.08F * forehead - 0.10F * on_lips(p) + uneven;
            const float kept = std::clamp(roughness, 0.35F, 0.6F);
            image->pixels.insert(image->pixels.end(),
                                 {0, static_cast<std::uint8_t>(std::lround(kept * 255)), 0});
        }
    }
    return image;
}

} // namespace stimuli::head
