// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_field.h"

#include <array>

#include "head_landmarks.h"

namespace stimuli::head {
namespace {

/// A soft lump of tissue (or a hollow, when its height is negative).
struct Lump {
    glm::vec3 centre; ///< mm
    glm::vec3 spread; ///< mm
    float height_mm;
};

constexpr std::array<Lump, 24> lumps{{
    {{28, 50, 88}, {20, 17, 30}, 1.2F},       // frontal eminence
    {{16, 18, 93}, {13, 8, 24}, 3.6F},        // brow ridge
    {{31, 20.5F, 88}, {13, 7, 22}, 3.0F},     // rising outwards
    {{0, 21, 95}, {11, 10, 20}, 2.2F},        // between the brows
    {{45, 16, 76}, {11, 8, 18}, 4.2F},        // its outer end
    {{39, 8, 80}, {12, 4.5F, 16}, 1.6F},      // soft tissue between brow and lid
    {{66, 28, 45}, {16, 20, 24}, -4.0F},      // temple
    {{15, 5, 84}, {6.5F, 7, 20}, -3.4F},      // inner corner of the socket
    {{27, 7, 82}, {12, 5, 18}, -2.2F},        // its roof
    {{47, -1, 72}, {9, 8, 18}, -1.8F},        // outer corner
    {{43, -24, 74}, {17, 12, 24}, 3.2F},      // cheekbone
    {{60, -20, 48}, {12, 10, 22}, 2.4F},      // its arch towards the ear
    {{27, -30, 84}, {10, 11, 20}, 1.2F},      // cheek beside the nose
    {{44, -48, 66}, {17, 17, 28}, 2.0F},      // fat of the cheek
    {{58, -55, 44}, {13, 16, 24}, -2.2F},     // hollow below the cheekbone
    {{0, -62, 94}, {20, 18, 26}, 3.6F},       // teeth carry the lips
    {{32, -66, 80}, {8, 11, 18}, 2.0F},       // muscle beside the mouth's corner
    {{25, -83, 82}, {8, 6, 16}, -1.4F},       // below the corner
    {{9, 2, 86}, {4, 12, 20}, -1.5F},         // beside the nose's root
    {{0, -84.5F, 94}, {17, 5.0F, 18}, -3.1F}, // groove above the chin
    {{0, -101, 92}, {15, 10, 22}, 6.0F},      // chin
    {{10, -102, 88}, {9, 8, 20}, 1.2F},       // its two halves
    {{28, -101, 72}, {12, 9, 16}, -1.2F},     // beside the chin
    {{50, -82, 14}, {16, 16, 24}, 2.8F},      // angle of the jaw
}};

/// What fifty years, from 20 to 70, add.
constexpr std::array<Lump, 9> ageing{{
    {{32, -15, 82}, {13, 4.5F, 16}, 1.5F},  // bags below the eyes
    {{33, -22, 80}, {17, 3.5F, 18}, -1.3F}, // and the groove below them
    {{40, 8, 80}, {14, 5, 18}, 1.2F},       // skin that hangs over the lid
    {{60, 22, 48}, {16, 18, 24}, -2.0F},    // temples
    {{52, -50, 56}, {15, 15, 24}, -2.0F},   // hollow cheeks
    {{33, -96, 66}, {12, 11, 18}, 3.0F},    // jowls
    {{24, -91, 78}, {5, 10, 14}, -1.6F},    // before them
    {{0, -124, 36}, {16, 9, 16}, 1.6F},     // below the chin
    {{0, -62, 98}, {20, 8, 18}, -1.0F},     // thinner upper lip
}};

float lump_height(const Lump& lump, glm::vec3 p) {
    const glm::vec3 rel = (p - lump.centre) / lump.spread;
    const float distance = glm::dot(rel, rel);
    return distance < 9 ? lump.height_mm * std::exp(-distance) : 0;
}

float add_nose(float skin, glm::vec3 p) {
    if (p.z < 60 || p.x > 40 || p.y > 30 || p.y < -66) {
        return skin;
    }
    // Bone and cartilage of the bridge, flanks that slope to the cheeks, the tip's two domes, and the septum
    // down to the lip.
    const float bridge = capsule(p, {0, 9, 86.8F}, {0, -23, 102.6F}, 5.2F, 7.0F);
    const float flank = capsule(p, {8.0F, -4, 76.5F}, {10.5F, -27, 91.0F}, 5.6F, 8.6F);
    const float tip = capsule(p, nose_tip, nose_tip + glm::vec3(3.0F, -0.3F, -0.8F), 6.6F, 6.0F);
    const float septum = capsule(p, {0, -37.4F, 106.0F}, {0, -43.4F, 96.5F}, 3.6F, 4.6F);
    float nose = join(bridge, flank, 15);
    nose = join(nose, tip, 11);
    skin = join(skin, nose, 9);
    skin = join(skin, septum, 8);

    // The wings sit on the cheeks with a crease around them; the nostrils open below.
    const float wing = capsule(p, {11.0F, -37.0F, 94.2F}, {6.8F, -35.4F, 102.0F}, 4.9F, 5.2F);
    skin += 0.7F * bell(wing - 0.8F, 2.2F) * smooth_step(103, 95, p.z) * smooth_step(-30, -38, p.y);
    skin = join(skin, wing, 2.8F);
    const float nostril = ellipsoid(p, {6.9F, -46.0F, 101.3F}, {3.3F, 4.6F, 5.0F});
    return carve(skin, -nostril, 3.2F);
}

float add_eye(float skin, glm::vec3 p) {
    if (p.z < 50 || p.x > 60 || p.x < 8 || std::abs(p.y) > 26) {
        return skin;
    }
    const float ball = glm::length(p - eye_centre) - eye_radius;
    skin = join(skin, ball, 9);

    // The upper lid ends in an edge on the lower one; a fold parts it from the brow, a faint one the lower
    // lid from the cheek.
    const float s = along_eye(p.x), inside = smooth_step(-0.12F, 0.1F, s) * smooth_step(1.16F, 0.9F, s);
    const float above = p.y - lid_line_y(p.x);
    const float upper_lid = smooth_step(-0.7F, 0.7F, above) * smooth_step(10, 1, above);
    const float lower_rim = bell(above + 2.2F, 1.6F);
    const float fold = bell(p.y - lid_fold_y(p.x), 1.7F);
    const float lower_fold = bell(above + 9 - 3 * square(s - 0.5F), 1.8F);
    return skin - inside * (0.9F * upper_lid + 0.3F * lower_rim - 0.55F * fold - 0.30F * lower_fold);
}

/// The trough from the inner corner of the eye down over the cheek, and the bag above it.
float add_tear_trough(const Person& person, float skin, glm::vec3 p) {
    if (p.z < 55 || p.x < 10 || p.x > 52 || p.y > 2 || p.y < -32) {
        return skin;
    }
    const float t = (p.x - 15) / 26;
    const float below = p.y - (-8 - 12 * std::pow(std::clamp(t, 0.0F, 1.2F), 0.8F));
    const float present = smooth_step(-0.12F, 0.12F, t) * smooth_step(1.35F, 0.7F, t);
    const float deep = 0.7F + 0.9F * std::max(person.age, 0.0F);
    const float bag = smooth_step(0.15F, 0.5F, t) * smooth_step(1.3F, 0.8F, t);
    return skin + deep * (0.8F * present * bell(below, 2.4F) - 0.7F * bag * bell(below - 4.6F, 3.0F));
}

float add_mouth(float skin, glm::vec3 p) {
    if (p.z < 55 || p.x > 40 || p.y > -43 || p.y < -97) {
        return skin;
    }
    // Philtrum, between two ridges.
    const float philtrum = smooth_step(-63.5F, -58.5F, p.y) * smooth_step(-43, -48, p.y);
    skin += philtrum * (1.3F * bell(p.x, 3.2F) - 0.6F * bell(p.x - 6, 2.8F));

    // Lips: the upper swells to its edge and turns down from there, the lower is fullest in its middle.
    const float s = p.x / mouth_half_width;
    const float full = std::pow(std::max(1 - s * s, 0.0F), 1.1F);
    const float line = lip_line_y(p.x), top = lip_top_y(p.x), bottom = lip_bottom_y(p.x);
    const float up = std::clamp((p.y - line) / std::max(top - line, 1.0F), 0.0F, 2.0F);
    const float down = std::clamp((line - p.y) / std::max(line - bottom, 1.0F), 0.0F, 2.0F);
    const float upper = smooth_step(1.7F, 0.8F, up) * (0.15F + 0.85F * smooth_step(-0.1F, 0.85F, up));
    const float lower = smooth_step(1.9F, 0.35F, down) * (0.2F + 0.8F * smooth_step(-0.05F, 0.5F, down));
    const float lips = p.y > line ? 4.6F * upper : 3.5F * lower;
    skin -= full * lips;
    // A narrow roll of pale skin borders the red.
    skin -= 0.25F * std::sqrt(full) * (bell(p.y - top - 0.9F, 1.2F) + 0.6F * bell(p.y - bottom + 0.9F, 1.3F));

    // The corners dip in, and the line between the lips runs into them.
    const float corner = bell(glm::length(glm::vec2(p.x - mouth_half_width - 0.5F, p.y + 69.8F)), 4.0F);
    const float parting = bell(p.y - line, 1.1F) * smooth_step(1.08F, 0.9F, s);
    return skin + 1.6F * corner + 0.9F * parting;
}

/// The fold from the nose's wing to beside the mouth: a rounded step from the cheek down to the lip.
float add_nasolabial_fold(const Person& person, float skin, glm::vec3 p) {
    if (p.z < 50 || p.y > -26 || p.y < -86) {
        return skin;
    }
    const float t = std::clamp((-36 - p.y) / 38, -0.2F, 1.2F);
    const float outside = p.x - (19.0F + 13.5F * t - 1.5F * arch(t));
    const float present = smooth_step(-0.15F, 0.2F, t) * smooth_step(1.1F, 0.45F, t);
    return skin - (0.9F + 1.1F * std::max(person.age, 0.0F)) * present *
                      (1.0F * smooth_step(-3, 4, outside) * smooth_step(19, 4, outside) -
                       0.75F * bell(outside + 1.5F, 2.6F));
}

} // namespace

float add_face(const Person& person, float skull, glm::vec3 p) {
    if (skull > 45 || skull < -30) {
        return skull;
    }
    float skin = skull;
    for (const Lump& lump : lumps) {
        skin -= lump_height(lump, p);
    }
    for (const Lump& lump : ageing) {
        skin -= std::max(person.age, 0.0F) * lump_height(lump, p);
    }
    skin = add_nasolabial_fold(person, skin, p);
    skin = add_tear_trough(person, skin, p);
    skin = add_mouth(skin, p);
    skin = add_eye(skin, p);
    return add_nose(skin, p);
}

} // namespace stimuli::head
