// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_maps.h"

#include <array>

#include <support/random.h>

#include "head_hair.h"
#include "head_landmarks.h"
#include "head_noise.h"
#include "head_pigment.h"

namespace stimuli::head {
namespace {

using renderer::scene::ImagePtr;

/// Colour of single hairs, and their grey (linear Rec. 709).
constexpr glm::vec3 brown_hair{0.012F, 0.007F, 0.005F}, grey_hair{0.34F, 0.285F, 0.225F};

/// A patch with more blood than its surroundings (share of the dermis), and more melanin (relative to the
/// person's own).
struct Patch {
    glm::vec3 centre, spread; ///< mm
    float blood, melanin;
};

constexpr float blood_everywhere = 0.025F;
constexpr std::array<Patch, 20> patches{{
    {{0, -31, 110}, {12, 10, 18}, 0.070F, -0.20F}, // tip of the nose
    {{13, -38, 97}, {7, 8, 12}, 0.070F, 0.05F},    // its wings
    {{0, -6, 98}, {8, 12, 20}, 0.004F, 0.05F},     // its bridge
    {{0, 7, 92}, {7, 6, 20}, -0.020F, 0.15F},      // its root
    {{43, -33, 76}, {16, 15, 30}, 0.050F, -0.30F}, // cheeks
    {{60, -54, 46}, {17, 22, 26}, 0.034F, -0.20F}, // their sides
    {{27, -17, 83}, {15, 6, 20}, -0.018F, 0.04F},  // below the eyes
    {{22, -12, 84}, {9, 4, 16}, 0.026F, 0.20F},    // and their shadow
    {{31, 2, 82}, {18, 9, 18}, 0.024F, 0.22F},     // lids and sockets
    {{16, -3, 78}, {6, 9, 14}, 0.022F, 0.20F},     // inner corners
    {{31, -6, 84}, {16, 3, 14}, 0.025F, 0.10F},    // the lids' edges
    {{0, -102, 90}, {14, 10, 20}, 0.036F, 0.0F},   // chin
    {{22, -57, 90}, {11, 12, 20}, -0.020F, 0.10F}, // above the lip
    {{26, 50, 86}, {22, 12, 40}, 0.004F, -0.05F},  // forehead
    {{6, 22, 98}, {12, 10, 20}, 0.026F, 0.0F},     // between the brows
    {{62, 22, 40}, {16, 22, 26}, -0.020F, 0.06F},  // temples
    {{90, -17, -30}, {22, 40, 22}, 0.050F, 0.0F},  // ears
    {{27, -70, 84}, {6, 6, 14}, 0.020F, 0.20F},    // corners of the mouth
    {{0, -84, 94}, {14, 5, 14}, -0.010F, 0.12F},   // below the lower lip
    {{0, -190, 20}, {60, 40, 60}, 0.012F, 0.10F},  // throat and chest
}};

float patch_weight(const Patch& patch, glm::vec3 p) {
    const glm::vec3 rel = (p - patch.centre) / patch.spread;
    const float distance = glm::dot(rel, rel);
    return distance < 12 ? std::exp(-distance) : 0;
}

/// 1 within a nostril, 0 away from it.
float nostril(glm::vec3 p) {
    return std::exp(-square((p.x - 7.2F) / 3.8F) - square((p.y + 46.2F) / 2.8F) - square((p.z - 100) / 8));
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

/// Everything that colours one head's skin.
class Skin {
public:
    explicit Skin(const Person& person)
        : person_(person), noise_("head albedo", person.seed), spots_("head spots", person.seed),
          hairs_(person),
          freckled_(person.seed == 0 ? 0.5F : smooth_step(-0.3F, 0.5F, noise_({0.5F, 0.5F, 0.37F}))),
          bearded_(person.seed == 0 ? 0.9F : smooth_step(-0.3F, 0.3F, noise_({7.5F, 0.31F, 0.5F}))) {
        freckled_ *= smooth_step(0.10F, 0.015F, person.melanin);
        support::Generator generator("head moles", person.seed);
        const auto between = [&](float low, float high) {
            return glm::mix(low, high, static_cast<float>(generator.uniform()));
        };
        for (glm::vec3& mole : moles_) {
            // Not where the face turns to the side, as moles are discs seen from the front.
            do {
                mole = {between(-46, 46), between(-86, 66), between(0.4F, 1.05F)};
            } while (square(mole.x / 46) + square((mole.y + 10) / 76) > 1);
        }
    }

    /// Linear colour of the skin with its hairs; dark in the nostrils and between the lips, where little
    /// light leaves.
    glm::vec3 operator()(glm::vec3 place, float texel_mm) const {
        const glm::vec3 p = person_.fold(place);
        const Pigment pigment = pigment_at(p, place);
        const float lips = red_of_lips(p, place);
        // On dark skin the lips' epidermis is no longer so thin beside its melanin.
        const float thin = lips * (0.45F + 0.50F * light_skin());
        const glm::vec3 skin =
            lips > 0 ? glm::mix(colours_(pigment), lip_colours_(pigment), thin) : colours_(pigment);
        const float parting = smooth_step(mouth_half_width + 1.5F, mouth_half_width - 4, p.x) *
                              bell(p.y - lip_line_y(p.x), 0.7F) * smooth_step(50, 60, p.z);
        const float lid_edge = lid_seam(p);
        const float shade = (1 - 0.8F * nostril(p)) * (1 - 0.7F * parting) * (1 - 0.6F * lid_edge);
        // Shaven hairs go on below the skin, where they take from the red light that comes back from the
        // depth.
        const glm::vec3 below =
            glm::mix(glm::vec3(1), glm::vec3(0.75F, 0.82F, 0.88F),
                     std::max(beard(p, place), 0.85F * scalp(p, place)) * (1 - 0.5F * person_.grey));
        const glm::vec3 shaven = glm::mix(
            skin * below * shade, glm::mix(brown_hair, grey_hair, 0.5F * person_.grey), stubble(p, place));
        const auto [share, grey] = hairs_.cover(p, place.x < 0 ? -1.0F : 1.0F, texel_mm);
        const glm::vec3 hair = share > 0 ? glm::mix(brown_hair, grey_hair, grey / share) : brown_hair;
        return glm::mix(shaven, hair, 0.97F * share);
    }

private:
    Pigment pigment_at(glm::vec3 p, glm::vec3 place) const {
        // The face of light skin holds less melanin than the rest.
        float blood = blood_everywhere, relative = glm::mix(0.85F, 0.65F, light_skin());
        for (const Patch& patch : patches) {
            const float weight = patch_weight(patch, p);
            blood += weight * patch.blood;
            relative += weight * patch.melanin;
        }
        // Mottle the skin, coarsely by its blood and finely by both; sun and years make melanin patchier, in
        // dark skin by a smaller share.
        const float age = std::max(person_.age, 0.0F);
        const float coarse = noise_.octaves(place / 19.0F, 3), fine = noise_.octaves(place / 2.4F, 2);
        blood *= std::max(1 + 0.7F * coarse + 0.28F * fine, 0.2F);
        const float share = light_skin();
        relative += share * (0.24F * (1 + age) * noise_.octaves(place / 17.0F + glm::vec3(50), 2) +
                             0.08F * noise_(place / 1.1F) + 2.2F * age_spots(p, place));
        relative += 0.12F * age + 2.4F * freckles(p, place) + 5 * share * share * moles(place);
        blood += 0.010F * age * vessels(p, place);

        const float lips = red_of_lips(p, place);
        if (lips > 0) {
            const float full = 0.155F - 0.05F * std::clamp(age, 0.0F, 1.0F);
            blood = glm::mix(blood, full * (1 + 0.25F * noise_(place * glm::vec3(0.7F, 0.15F, 0.3F))), lips);
            relative = glm::mix(relative, 3 - 1.6F * share, lips);
        }
        return {person_.melanin * std::max(relative, 0.2F), std::max(blood, 0.004F)};
    }

    /// 1 on skin with little melanin, 0 on the darkest.
    float light_skin() const { return smooth_step(0.4F, 0.03F, person_.melanin); }

    /// The red of the lips, whose border wanders.
    float red_of_lips(glm::vec3 p, glm::vec3 place) const {
        if (p.z < 50 || p.y < -90 || p.y > -50) {
            return 0;
        }
        p.y += 0.9F * noise_(place / 3.4F) + 0.5F * noise_(place * glm::vec3(0.9F, 0.3F, 0.3F));
        return on_lips(p);
    }

    /// Small brown spots, many over the nose and the cheeks.
    float freckles(glm::vec3 p, glm::vec3 place) const {
        const float where =
            freckled_ * std::exp(-square(p.x / 56) - square((p.y + 22) / 28)) * smooth_step(30, 60, p.z);
        if (where < 0.02F) {
            return 0;
        }
        return where *
               smooth_step(0.42F, 0.75F, spots_(place / 1.6F + glm::vec3(31)) + 0.5F * spots_(place / 9.0F));
    }

    /// A few single moles, anywhere on the front of the head.
    float moles(glm::vec3 place) const {
        float most = 0;
        for (const glm::vec3& mole : moles_) {
            const float distance = glm::length(glm::vec2(place) - glm::vec2(mole));
            most = std::max(most, smooth_step(1.15F * mole.z, 0.55F * mole.z, distance));
        }
        return place.z > 20 ? most : 0;
    }

    /// Broad flat spots that come with age, on temples, cheeks and scalp.
    float age_spots(glm::vec3 p, glm::vec3 place) const {
        const float years = smooth_step(0.45F, 1.25F, person_.age);
        if (years <= 0 || p.y < -95) {
            return 0;
        }
        const float where = years * (0.35F + 0.65F * smooth_step(25, 50, p.x));
        const float edge = spots_.octaves(place / 7.5F + glm::vec3(70), 3);
        return where * smooth_step(0.62F - 0.12F * years, 0.75F, edge);
    }

    /// Fine widened vessels over cheeks and nose.
    float vessels(glm::vec3 p, glm::vec3 place) const {
        const float where =
            std::exp(-square((p.x - 30) / 28) - square((p.y + 36) / 16)) * smooth_step(45, 70, p.z);
        return where < 0.03F ? 0 : where * bell(spots_(place / 3.1F + 0.4F * noise_(place / 1.4F)), 0.10F);
    }

    /// Where the scalp's hair would grow, 0 to 1.
    float scalp(glm::vec3 p, glm::vec3 place) const {
        return 0.9F * smooth_step(-10, 12, p.y - hairline_y(p.z) + 5 * noise_(place / 9.0F));
    }

    /// Where the beard grows, 0 to 1.
    float beard(glm::vec3 p, glm::vec3 place) const {
        const float ragged = 5 * noise_(place / 9.0F);
        const float jaw = smooth_step(
            -46, -70, p.y + 0.45F * std::max(p.x - 30, 0.0F) * smooth_step(60, 20, p.z) + 0.5F * ragged);
        const float front =
            smooth_step(-5, 25, p.z) * smooth_step(-150, -122, p.y) * smooth_step(106, 100, p.z);
        return bearded_ * jaw * front * (1 - on_lips(p)) * smooth_step(-44, -49, p.y);
    }

    /// Shaven hair's ends, in fine dots.
    float stubble(glm::vec3 p, glm::vec3 place) const {
        const float beards = beard(p, place), all = std::max(scalp(p, place), beards);
        if (all <= 0) {
            return 0;
        }
        const float dots = smooth_step(0.28F, 0.55F, spots_(place / 0.7F));
        return all * (1 - 0.5F * person_.grey) * (0.09F + glm::mix(0.28F, 0.50F, beards) * dots);
    }

    float lid_seam(glm::vec3 p) const {
        const float s = along_eye(p.x);
        if (p.z < 40 || s < -0.05F || s > 1.1F) {
            return 0;
        }
        return smooth_step(-0.03F, 0.1F, s) * smooth_step(1.08F, 0.95F, s) *
               bell(p.y - lid_line_y(p.x), 0.55F);
    }

    const Person& person_;
    Noise noise_, spots_;
    Hairs hairs_;
    SkinColours colours_, lip_colours_{lip_epidermis_mm};
    float freckled_, bearded_;
    std::array<glm::vec3, 8> moles_{}; ///< x, y and radius, mm
};

std::uint8_t srgb_byte(float linear) {
    const float clamped = std::clamp(linear, 0.0F, 1.0F);
    const float encoded =
        clamped <= 0.0031308F ? 12.92F * clamped : 1.055F * std::pow(clamped, 1 / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(encoded * 255));
}

} // namespace

ImagePtr albedo_map(const Person& person, const Atlas& atlas) {
    const Skin skin(person);
    return filled_map([&](int x, int y) -> Texel {
        const glm::vec3 colour = skin(atlas.place_mm(x, y), atlas.texel_mm(x, y));
        return {srgb_byte(colour.x), srgb_byte(colour.y), srgb_byte(colour.z)};
    });
}

ImagePtr reflection_map(const Person& person, const Atlas& atlas) {
    const Noise noise("head roughness", person.seed), film("head sebum", person.seed);
    const Hairs hairs(person);
    return filled_map([&](int x, int y) -> TexelWithAlpha {
        // Nose and forehead are oily, the lips moist, the rest dry, and drier with age; hairs lie every way.
        // Oil and moisture smooth the surface and make it reflect more; light that falls into a nostril is
        // lost. How much, no measurement says: the shares are chosen by eye.
        const glm::vec3 place = atlas.place_mm(x, y), p = person.fold(place);
        const float nose = std::exp(-square(p.x / 18) - square((p.y + 32) / 22)) * smooth_step(70, 85, p.z);
        const float forehead =
            std::exp(-square(p.x / 42) - square((p.y - 42) / 24)) * smooth_step(40, 70, p.z);
        const float cheek =
            std::exp(-square((p.x - 42) / 16) - square((p.y + 26) / 13)) * smooth_step(40, 70, p.z);
        const float uneven = 0.05F * noise.octaves(place / 4.0F, 2) + 0.03F * noise(place / 0.7F);
        const float scalp = 0.07F * smooth_step(60, 85, p.y);
        const float dry = 0.03F * std::clamp(person.age - 0.5F, -0.5F, 1.0F);
        const float roughness = 0.41F + dry + scalp - 0.12F * nose - 0.05F * forehead - 0.07F * cheek -
                                0.08F * on_lips(p) + uneven;
        const float hair = hairs.cover(p, place.x < 0 ? -1.0F : 1.0F, atlas.texel_mm(x, y)).share;
        const float kept = std::clamp(glm::mix(roughness, 0.6F, hair), 0.25F, 0.6F);
        const float coated = std::max({0.85F * nose, 0.7F * forehead, 0.4F * cheek, on_lips(p)});
        const float strength = (0.68F - 2 * dry + 0.32F * coated + 0.1F * film.octaves(place / 9.0F, 3)) *
                               (1 - 0.5F * hair) * (1 - 0.8F * nostril(p));
        const float kept_strength = std::clamp(strength, 0.1F, 1.0F);
        return {0, static_cast<std::uint8_t>(std::lround(kept * 255)), 0,
                static_cast<std::uint8_t>(std::lround(kept_strength * 255))};
    });
}

} // namespace stimuli::head
