// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_lines.h"

#include "head_landmarks.h"
#include "head_maps.h"

namespace stimuli::head {
namespace {

/// A valley along the zeros of a noise: 1 in its middle, 0 beyond `width` of the noise's values.
float valley(float noise, float width) { return bell(noise, width); }

/// A fold with a sharp bottom: 1 in its middle, its shoulders `width_mm` away.
float furrow(float offset_mm, float width_mm) {
    return std::exp(-std::abs(offset_mm) / width_mm) * bell(offset_mm, 3 * width_mm);
}

/// Lines across the forehead, and between the brows.
float forehead_mm(const Noise& noise, glm::vec3 p, glm::vec3 place) {
    const float where = std::exp(-square(p.x / 40) - square((p.y - 46) / 19));
    float depth = 0;
    if (where > 0.02F) {
        const float sway = 2.2F * noise(place / 26.0F) + 0.8F * noise(place / 7.0F);
        int line = 0;
        for (const float y : {35.0F, 45.5F, 55.0F}) {
            const float rise = y + sway + 2.5F * bell(p.x - 24, 20);
            const float broken = smooth_step(-0.35F, 0.15F, noise({place.x / 24, y, 0.5F}));
            depth += (line == 1 ? 0.22F : 0.14F) * broken * furrow(p.y - rise, 0.75F);
            ++line;
        }
        depth += 0.05F * valley(noise({p.x / 45, p.y / 5.0F + 0.25F * noise(place / 18.0F), 3.3F}), 0.10F);
    }
    const float glabella = smooth_step(6, 13, p.y) * smooth_step(34, 22, p.y);
    const float frown = p.x - 8.5F - 0.09F * (p.y - 20) + 0.8F * noise(place / 8.0F);
    return where * depth + 0.10F * glabella * furrow(frown, 0.7F);
}

/// Lines around the eye: along the lids, and fanned out from its outer corner.
float eye_mm(const Noise& noise, glm::vec3 p, glm::vec3 place) {
    const float side = place.x < 0 ? 4.5F : 2.5F, s = along_eye(p.x);
    const float lids =
        std::exp(-square((p.x - 32) / 16)) * smooth_step(-21, -9, p.y) * smooth_step(13, 6, p.y);
    float depth = 0.025F * lids * valley(noise({p.x / 15, (p.y + 4.6F * arch(s)) / 1.7F, side + 5}), 0.13F);
    depth += 0.025F * lids * valley(noise({p.x / 8 + 0.3F * p.y, p.y / 1.2F - 0.12F * p.x, side + 9}), 0.10F);

    const glm::vec2 from_corner(p.x - eye_outer_x + 5, p.y + 2.5F);
    const float reach = glm::length(from_corner), angle = std::atan2(from_corner.y, from_corner.x);
    // Outwards and downwards, not up through the brow; evenly spread, so that none runs into another.
    const float fan = smooth_step(3, 8, reach) * smooth_step(27, 11, reach) *
                      smooth_step(0, 6, from_corner.x) * smooth_step(0.95F, 0.5F, angle);
    const float across = 11 * angle + 1.5F * noise({reach / 9, angle, side}) + side;
    const float uneven = 0.65F + 0.5F * noise({reach / 8, angle * 3, side + 20});
    return depth + 0.14F * fan * uneven * valley(std::sin(across), 0.14F);
}

/// Lines around the mouth: from the nose's wing down beside it, below its corner, and short ones down to the
/// lip.
float mouth_mm(const Person& person, const Noise& noise, glm::vec3 p, glm::vec3 place) {
    const float t = std::clamp((-36 - p.y) / 38, -0.2F, 1.2F);
    const float sway = 0.9F * noise(place / 12.0F);
    const float fold = p.x - (18.5F + 13.5F * t - 1.5F * arch(t)) + sway;
    const float folded = smooth_step(-0.05F, 0.25F, t) * smooth_step(1.1F, 0.6F, t);
    float depth = 0.09F * folded * furrow(fold, 0.8F);

    const float older = std::max(person.age - 0.5F, 0.0F);
    const float down = smooth_step(-69, -74, p.y) * smooth_step(-95, -81, p.y);
    depth += 0.5F * older * down * furrow(p.x - 28.5F - 0.22F * (-70 - p.y) + sway, 0.8F);
    const float end_y = p.y + 4 * noise({p.x / 2.6F, 0.5F, place.x < 0 ? 13.5F : 14.5F});
    const float above = smooth_step(-63, -60, p.y) * smooth_step(-51, -59, end_y) * smooth_step(27, 18, p.x);
    depth +=
        0.15F * older * above * valley(noise({p.x / 2.3F, p.y / 22, place.x < 0 ? 11.5F : 12.5F}), 0.12F);
    return depth;
}

/// What ages the whole skin: crossing lines on the cheeks, rings around the neck.
float age_mm(const Person& person, const Noise& noise, glm::vec3 p, glm::vec3 place) {
    const float older = std::max(person.age - 0.4F, 0.0F);
    float depth = 0.06F * std::min(1.0F, 0.4F + person.age) *
                  bell(p.y + 133 + 3 * noise(place / 30.0F) + 0.10F * p.x, 1.2F) * smooth_step(-30, 0, p.z);
    if (older > 0) {
        const float cheek =
            std::exp(-square((p.x - 48) / 22) - square((p.y + 42) / 34)) * smooth_step(20, 45, p.z);
        const glm::vec3 slanted(p.x / 7 + p.y / 22, p.y / 26 - p.x / 30, place.x < 0 ? 3.5F : 6.5F);
        depth += 0.13F * older * cheek *
                 (valley(noise(slanted), 0.06F) + 0.6F * valley(noise(2.1F * slanted), 0.09F));
    }
    return depth;
}

} // namespace

float lines_mm(const Person& person, const Noise& noise, glm::vec3 p, glm::vec3 place) {
    if (p.z < -10 || p.y > 80 || p.y < -160) {
        return 0;
    }
    float depth = age_mm(person, noise, p, place);
    if (p.z > 35 && p.y > -125) {
        depth += person.wrinkled * (forehead_mm(noise, p, place) + eye_mm(noise, p, place)) +
                 person.wrinkled * mouth_mm(person, noise, p, place);
    }

    // Everyone has a crease where the lids fold and where they meet.
    const float s = along_eye(p.x);
    const float present =
        smooth_step(-0.05F, 0.1F, s) * smooth_step(1.12F, 0.95F, s) * smooth_step(35, 45, p.z);
    depth +=
        present * (0.06F * bell(p.y - lid_fold_y(p.x), 0.9F) + 0.45F * bell(p.y - lid_line_y(p.x), 0.4F));

    // Lips are grooved from edge to edge and parted by a sharp line.
    const float lips = on_lips(p);
    if (lips > 0) {
        const float sideways = p.x * 0.62F + 0.3F * noise(place / 3.0F);
        depth += 0.075F * lips * valley(noise({sideways, p.y * 0.09F, place.x < 0 ? 7.7F : 0.7F}), 0.16F);
        depth += 0.035F * lips * valley(noise({2.1F * sideways, p.y * 0.2F, 5.2F}), 0.2F);
    }
    depth += 0.3F * smooth_step(1.05F, 0.8F, p.x / mouth_half_width) * bell(p.y - lip_line_y(p.x), 0.45F) *
             smooth_step(50, 60, p.z);
    return depth;
}

} // namespace stimuli::head
