// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_surface.h"

#include <array>
#include <cstddef>

#include <glm/gtc/constants.hpp>

#include "head_landmarks.h"

namespace stimuli::head {
namespace {

// The ear's root is an ellipse on the side of the head. Its inner part is stretched over the ear's outer
// face, the ring around that runs back from the rim to the head. All lengths in mm.
constexpr float root_half_length = 19, root_half_height = 32;
constexpr float rim_share = 0.76F;                         // of the root's radius
constexpr float stand_off = 0.56F;                         // radians between the ear and the head
constexpr float full_rim_thickness = 4, roll_share = 0.4F; // the rim rolls over in this part of the ring
constexpr float ear_height = 62, ear_width = 35;

/// Reach of the ear's outline from the root's centre; `back` and `up` are a direction's cosines.
float outline(float back, float up) {
    const float reach_back = back > 0 ? 0.66F * ear_width : 0.36F * ear_width;
    const float reach_up = up > 0 ? 0.53F * ear_height : 0.47F * ear_height;
    const float ellipse = 1 / std::sqrt(square(back / reach_back) + square(up / reach_up));
    // The upper back is fuller than an ellipse, the lobe narrower.
    const float fuller = 2 * std::max(back, 0.0F) * up;
    return ellipse * (1 + 0.10F * fuller);
}

/// Height of a ridge along a line through places of the ear, 1 on it; its flanks are `width` wide.
template <std::size_t count>
float ridge(const std::array<glm::vec2, count>& line, glm::vec2 at, float width) {
    float nearest = 10;
    for (std::size_t k = 0; k + 1 < count; ++k) {
        const glm::vec2 edge = line[k + 1] - line[k], rel = at - line[k];
        const float t = std::clamp(glm::dot(rel, edge) / glm::dot(edge, edge), 0.0F, 1.0F);
        nearest = std::min(nearest, glm::length(rel - edge * t));
    }
    return bell(nearest, width);
}

// The antihelix rises from above the lobe and forks; the helix begins in the bowl. Backwards and up, as
// shares of the outline's reach.
constexpr std::array<glm::vec2, 6> antihelix_line{
    {{0.10F, -0.55F}, {0.36F, -0.42F}, {0.50F, -0.18F}, {0.48F, 0.12F}, {0.34F, 0.36F}, {0.16F, 0.66F}}};
constexpr std::array<glm::vec2, 3> fork_line{{{0.36F, 0.34F}, {0.0F, 0.36F}, {-0.40F, 0.40F}}};
constexpr std::array<glm::vec2, 3> crus_line{{{0.08F, 0.02F}, {-0.40F, 0.06F}, {-0.86F, 0.34F}}};

/// Height of the outer face above the ear's plane: helix, antihelix, the bowl, tragus, lobe. `s` runs from 0
/// at the centre to 1 at the rim.
float relief(float s, float back, float up) {
    const glm::vec2 at(s * back, s * up);
    const auto lump = [&](float x, float y, float wide, float high) {
        return std::exp(-square((at.x - x) / wide) - square((at.y - y) / high));
    };
    const float lobe = smooth_step(-0.45F, -0.75F, at.y);
    const float rolled =
        smooth_step(-0.80F, -0.35F, back + 0.6F * up) * (1 - smooth_step(-0.35F, -0.75F, up));
    const float helix = 3.4F * rolled * bell(s - 0.93F, 0.10F);
    const float gutter = -2.6F * rolled * bell(s - 0.76F, 0.10F) * smooth_step(-0.2F, 0.3F, back + 0.5F * up);
    const float antihelix = 3.9F * ridge(antihelix_line, at, 0.15F) + 2.0F * ridge(fork_line, at, 0.11F);
    const float crus = 2.6F * ridge(crus_line, at, 0.10F);
    const float bowl = -7.5F * lump(-0.08F, -0.20F, 0.36F, 0.26F) - 3.5F * lump(-0.05F, 0.19F, 0.34F, 0.11F);
    const float canal = -3.0F * lump(-0.45F, -0.14F, 0.16F, 0.14F);
    const float fossa = -2.2F * lump(-0.12F, 0.58F, 0.20F, 0.13F);
    const float tragus = 4.2F * lump(-0.80F, -0.18F, 0.22F, 0.19F);
    const float antitragus = 2.6F * lump(0.06F, -0.58F, 0.17F, 0.10F);
    const float notch = -2.6F * lump(-0.32F, -0.52F, 0.14F, 0.12F);
    const float soft_lobe = 1.4F * lobe * bell(s - 0.72F, 0.25F);
    return helix + gutter + antihelix + crus + bowl + canal + fossa + tragus + antitragus + notch + soft_lobe;
}

} // namespace

glm::vec3 add_ear(glm::vec3 place_mm) {
    // Find the place in the root's own directions: backwards and up along the tilted ear.
    const float side = place_mm.x < 0 ? -1.0F : 1.0F;
    if (std::abs(place_mm.x) < 40) {
        return place_mm;
    }
    const float dz = -(place_mm.z - ear_root.z), dy = place_mm.y - ear_root.y;
    const float back = std::cos(ear_tilt) * dz - std::sin(ear_tilt) * dy;
    const float up = std::sin(ear_tilt) * dz + std::cos(ear_tilt) * dy;
    const glm::vec2 root(back / root_half_length, up / root_half_height);
    const float radius = glm::length(root);
    if (radius >= 1) {
        return place_mm;
    }
    const glm::vec2 toward = radius > 1e-4F ? root / radius : glm::vec2(0, 1);
    const float s = std::min(radius / rim_share, 1.0F);

    // Lay the inner part out over the ear's plane, which stands off the head, and roll its rim over.
    const float ring = std::max(radius - rim_share, 0.0F) / (1 - rim_share);
    const float roll = glm::pi<float>() * std::min(ring / roll_share, 1.0F);
    const float rim_thickness = full_rim_thickness * smooth_step(-0.95F, -0.3F, toward.x);
    const float reach = outline(toward.x, toward.y) * s + 0.5F * rim_thickness * std::sin(roll);
    const float lift = relief(s, toward.x, toward.y) - 0.5F * rim_thickness * (1 - std::cos(roll));
    const float ear_back = reach * toward.x, ear_up = reach * toward.y, front = 0.36F * ear_width;
    const float out =
        1.5F + (ear_back + front) * std::sin(stand_off) + lift * std::cos(stand_off) + 2.0F * s * s;
    const float behind = (ear_back + front) * std::cos(stand_off) - front - lift * std::sin(stand_off);
    const float flat = radius > rim_share ? rim_share / radius : 1;

    // Bring the rest of the ring back to the head.
    const float back_home =
        1 - square(1 - std::max(ring - 0.3F * roll_share, 0.0F) / (1 - 0.3F * roll_share));
    const glm::vec3 move = (1 - back_home) * glm::vec3(out, ear_up - up * flat, behind - back * flat);
    const float move_z = -(std::cos(ear_tilt) * move.z + std::sin(ear_tilt) * move.y);
    const float move_y = std::cos(ear_tilt) * move.y - std::sin(ear_tilt) * move.z;
    return place_mm + glm::vec3(side * move.x, move_y, move_z);
}

} // namespace stimuli::head
