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

constexpr std::array<Lump, 21> lumps{{
    {{27, 50, 88}, {22, 18, 30}, 1.6F},       // frontal eminence
    {{21, 20, 92}, {18, 9, 24}, 3.7F},        // brow ridge
    {{0, 25, 95}, {13, 10, 20}, 0.9F},        // between the brows
    {{43, 15, 78}, {12, 8, 18}, 4.2F},        // its outer end
    {{33, 7, 82}, {13, 5, 16}, 2.2F},         // soft tissue between brow and lid
    {{66, 28, 45}, {16, 20, 24}, -2.5F},      // temple
    {{12, 3, 84}, {7.5F, 10, 20}, -6.0F},     // inner corner of the socket
    {{31, -13, 80}, {16, 6.5F, 18}, -2.8F},   // below the lower lid
    {{46, 0, 72}, {9, 8, 18}, -4.5F},         // outer corner
    {{43, -24, 74}, {17, 14, 24}, 4.6F},      // cheekbone
    {{60, -20, 48}, {12, 10, 22}, 2.4F},      // its arch towards the ear
    {{49, -54, 60}, {20, 20, 30}, 5.4F},      // fat of the cheek
    {{0, -66, 94}, {20, 20, 26}, 5.4F},       // teeth carry the lips
    {{35, -63, 78}, {14, 19, 22}, 4.4F},      // fullness beside the mouth
    {{24, -48, 84}, {9, 12, 18}, 1.4F},       // beside the nose's wing
    {{9, 2, 86}, {4, 12, 20}, -1.5F},         // beside the nose's root
    {{0, -89.5F, 92}, {17, 4.5F, 18}, -3.4F}, // groove above the chin
    {{0, -102, 90}, {17, 11, 22}, 7.0F},      // chin
    {{27, -101, 72}, {12, 9, 16}, -0.8F},     // beside the chin
    {{0, -7, 84}, {40, 16, 22}, -1.0F},       // middle of the face
    {{50, -82, 14}, {16, 16, 24}, 3.4F},      // angle of the jaw
}};

/// What fifty years, from 20 to 70, add.
constexpr std::array<Lump, 9> ageing{{
    {{32, -15, 82}, {13, 4.5F, 16}, 1.5F},  // bags below the eyes
    {{33, -22, 80}, {17, 3.5F, 18}, -1.3F}, // and the groove below them
    {{38, 8, 80}, {16, 5, 18}, 1.2F},       // skin that hangs over the lid
    {{60, 22, 48}, {16, 18, 24}, -2.0F},    // temples
    {{52, -50, 56}, {15, 15, 24}, -1.6F},   // hollow cheeks
    {{33, -97, 66}, {12, 11, 18}, 2.6F},    // jowls
    {{24, -92, 78}, {5, 10, 14}, -1.2F},    // before them
    {{0, -124, 36}, {16, 9, 16}, 1.6F},     // below the chin
    {{0, -64, 98}, {20, 8, 18}, -1.0F},     // thinner upper lip
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
    // Bone and cartilage of the bridge, wide flanks, the tip, and the septum down to the lip.
    const float bridge = capsule(p, {0, 6, 85.2F}, {0, -29, 105.0F}, 3.8F, 6.3F);
    const float flank = capsule(p, {4, -4, 78}, {8.2F, -35, 91}, 3.6F, 7.6F);
    const float tip = glm::length((p - nose_tip) / glm::vec3(1.06F, 1, 1)) - 8.0F;
    const float septum = capsule(p, {0, -41, 105.0F}, {0, -47, 92}, 4.2F, 5.2F);
    float nose = join(bridge, flank, 14);
    nose = join(nose, tip, 13);
    skin = join(skin, nose, 10);
    skin = join(skin, septum, 5);

    // The wings sit on the cheeks with a crease around them; the nostrils open below.
    const float wing = capsule(p, {12.0F, -40.6F, 91.5F}, {6.5F, -39.5F, 101.5F}, 5.0F, 5.2F);
    skin += 1.1F * bell(wing - 0.6F, 1.9F) * smooth_step(102, 94, p.z);
    skin = join(skin, wing, 2.8F);
    const float nostril = ellipsoid(p, {7.0F, -50.0F, 99.0F}, {3.6F, 6.0F, 6.2F});
    return carve(skin, -nostril, 2.0F);
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
    return skin - inside * (0.9F * upper_lid + 0.3F * lower_rim - 0.25F * fold - 0.25F * lower_fold);
}

float add_mouth(float skin, glm::vec3 p) {
    if (p.z < 55 || p.x > 40 || p.y > -48 || p.y < -100) {
        return skin;
    }
    // Philtrum, between two ridges.
    const float philtrum = smooth_step(-66, -61, p.y) * smooth_step(-47, -52, p.y);
    skin += philtrum * (1.3F * bell(p.x, 3.2F) - 0.6F * bell(p.x - 6, 2.8F));

    // Lips: the upper swells to its edge and turns down from there, the lower is fullest in its middle.
    const float s = p.x / mouth_half_width;
    const float full = std::pow(std::max(1 - s * s, 0.0F), 1.1F);
    const float line = lip_line_y(p.x), top = lip_top_y(p.x), bottom = lip_bottom_y(p.x);
    const float up = std::clamp((p.y - line) / std::max(top - line, 1.0F), 0.0F, 2.0F);
    const float down = std::clamp((line - p.y) / std::max(line - bottom, 1.0F), 0.0F, 2.0F);
    const float upper = smooth_step(1.7F, 0.8F, up) * (0.15F + 0.85F * smooth_step(-0.1F, 0.85F, up));
    const float lower = smooth_step(1.5F, 0.4F, down) * (0.2F + 0.8F * smooth_step(-0.05F, 0.5F, down));
    const float lips = p.y > line ? 4.0F * upper : 4.2F * lower;
    skin -= full * lips;

    // The corners dip in, and the line between the lips runs into them.
    const float corner = bell(glm::length(glm::vec2(p.x - mouth_half_width - 0.5F, p.y + 71.6F)), 4.0F);
    const float parting = bell(p.y - line, 1.1F) * smooth_step(1.08F, 0.9F, s);
    return skin + 1.6F * corner + 0.9F * parting;
}

/// The fold from the nose's wing to beside the mouth: a rounded step from the cheek down to the lip.
float add_nasolabial_fold(const Person& person, float skin, glm::vec3 p) {
    if (p.z < 50 || p.y > -30 || p.y < -90) {
        return skin;
    }
    const float t = std::clamp((-40 - p.y) / 38, -0.2F, 1.2F);
    const float outside = p.x - (19.5F + 13.5F * t - 1.5F * arch(t));
    const float present = smooth_step(-0.15F, 0.2F, t) * smooth_step(1.1F, 0.45F, t);
    return skin - (0.55F + 0.9F * std::max(person.age, 0.0F)) * present *
                      (0.9F * smooth_step(-5, 5, outside) * smooth_step(17, 5, outside) -
                       0.5F * bell(outside + 1, 2.6F));
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
    skin = add_mouth(skin, p);
    skin = add_eye(skin, p);
    return add_nose(skin, p);
}

} // namespace stimuli::head
