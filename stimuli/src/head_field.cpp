// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "head_field.h"

#include <array>
#include <cstddef>

#include "head_landmarks.h"

namespace stimuli::head {
namespace {

/// One horizontal section of the head: two half superellipses that meet where the head is widest.
struct Section {
    float half_width; ///< of the widest place
    float widest_z;
    float front_z, back_z; ///< on the midline, without nose and lips
    float exponent;        ///< of the front half; 2 is an ellipse, more is squarer
};

/// Sections from the widest place of the skull downwards, for a head that comes out 152 mm wide and 197 mm
/// long.
constexpr float top_y = 42, spacing_y = 20;
constexpr std::array<Section, 9> sections{{
    {76.0F, -24, 93.0F, -103, 2.35F},  // y = 42, the widest place of the skull
    {75.2F, -20, 92.5F, -101, 2.45F},  // 22, brows
    {72.0F, -11, 81.5F, -93.5F, 2.6F}, // 2, eyes
    {69.4F, -2, 86.0F, -78, 2.6F},     // -18, cheekbones
    {66.6F, 2, 91.0F, -62, 2.5F},      // -38, nose
    {63.0F, 4, 95.0F, -47, 2.4F},      // -58, upper lip
    {58.0F, 4, 94.5F, -34, 2.3F},      // -78, lower lip
    {50.5F, 9, 92.5F, -22, 2.2F},      // -98, chin
    {41.0F, 16, 87.0F, -10, 2.1F},     // -118
}};

/// The section at a height: a uniform cubic B-spline, level at the top, whose curvature has no jumps.
Section section_at(float y) {
    const float last = static_cast<float>(sections.size() - 1);
    const float place = std::clamp((top_y - y) / spacing_y, 0.0F, last);
    const int piece = std::min(static_cast<int>(place), static_cast<int>(last) - 1);
    const float t = place - static_cast<float>(piece), r = 1 - t;
    const std::array<float, 4> weights{r * r * r / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                                       (3 * r * r * r - 6 * r * r + 4) / 6, t * t * t / 6};
    Section result{};
    for (int k = 0; k < 4; ++k) {
        const int index = std::min(std::abs(piece + k - 1), static_cast<int>(last));
        const Section& section = sections[static_cast<std::size_t>(index)];
        for (float Section::*field : {&Section::half_width, &Section::widest_z, &Section::front_z,
                                      &Section::back_z, &Section::exponent}) {
            result.*field += weights[static_cast<std::size_t>(k)] * section.*field;
        }
    }
    return result;
}

/// Skull and jaw: the sections, domed above the widest one and cut along the jaw's lower edge.
float skull(glm::vec3 p) {
    const Section s = section_at(p.y);
    const float z = p.z - s.widest_z, rise = std::max(p.y - top_y, 0.0F);
    const bool front = z > 0;
    const float exponent = front ? s.exponent : 2.1F;
    const float depth = front ? s.front_z - s.widest_z : s.widest_z - s.back_z;
    const float across =
        std::pow(std::abs(p.x) / s.half_width, exponent) + std::pow(std::abs(z) / depth, exponent);
    const float dome = rise / (vertex_y - top_y);
    const float scale = std::sqrt(std::pow(across, 2 / exponent) + dome * dome);
    const float radius = glm::length(glm::vec3(p.x, rise, z));
    const float body = scale > 0.05F ? (scale - 1) * radius / scale : -40;

    // The jaw's edge rises from the chin to the angle below the ear.
    constexpr float jaw_slope = 0.40F;
    const float below = (chin_y - 3.5F - p.y + (80 - p.z) * jaw_slope) / std::sqrt(1 + jaw_slope * jaw_slope);
    return carve(body, below, 26);
}

/// Neck, with its two oblique muscles and the larynx, shoulders that flare out from its back, collar bones,
/// chest.
float bust(glm::vec3 p) {
    const float axis_z = -21 + 0.25F * (p.y + 130);
    const float neck = std::max((glm::length(glm::vec2(p.x / 52, (p.z - axis_z) / 56)) - 1) * 52, p.y + 15);
    const float flare = std::pow(smooth_step(-100, -258, p.y), 1.4F);
    const float half_width = 40 + 170 * flare, thickness = 25 + 24 * smooth_step(-120, -240, p.y);
    const float ridge_z = -36 - 21 * smooth_step(-80, -200, p.y);
    const float half_depth = p.z > ridge_z ? 1.5F * thickness : thickness;
    const glm::vec2 section(p.x / half_width, (p.z - ridge_z) / half_depth);
    const float shoulders = carve((glm::length(section) - 1) * thickness, p.y + 60, 40);
    const float sternomastoid = capsule(p, {54, -48, -20}, {11, -204, 23}, 11, 7);
    const float larynx = capsule(p, {0, -142, 31}, {0, -190, 14}, 8, 10);
    const float chest = ellipsoid(p, {0, -300, -42}, {185, 112, 76});
    const float collar_bone = capsule(p, {15, -206, 18}, {140, -200, -28}, 6, 5);

    float all = join(neck, shoulders, 30);
    all = join(all, sternomastoid, 11);
    all = join(all, larynx, 11);
    all = join(all, chest, 50);
    return join(all, collar_bone, 13);
}

} // namespace

float join(float a, float b, float width_mm) {
    const float near = std::max(width_mm - std::abs(a - b), 0.0F) / width_mm;
    return std::min(a, b) - near * near * width_mm / 4;
}

float carve(float a, float b, float width_mm) { return -join(-a, -b, width_mm); }

float capsule(glm::vec3 place, glm::vec3 from, glm::vec3 to, float from_radius, float to_radius) {
    const glm::vec3 axis = to - from, rel = place - from;
    const float t = std::clamp(glm::dot(rel, axis) / glm::dot(axis, axis), 0.0F, 1.0F);
    return glm::length(rel - axis * t) - (from_radius + (to_radius - from_radius) * t);
}

float ellipsoid(glm::vec3 place, glm::vec3 centre, glm::vec3 radii) {
    const glm::vec3 rel = place - centre;
    const float scale = glm::length(rel / radii), slope = glm::length(rel / (radii * radii));
    return slope > 0 ? scale * (scale - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

float field(const Person& person, glm::vec3 place_mm) {
    const glm::vec3 p = person.fold(place_mm);
    const float below_chin = capsule(p, {0, -96, 54}, {0, -126, 20}, 10, 21);
    const float body = join(join(skull(p), below_chin, 22), bust(p), 16);
    const float skin = p.z > -40 && p.y < 90 && p.y > -135 ? add_face(person, body, p) : body;
    constexpr float floor_y = -252;
    return carve(skin, floor_y - p.y, 12);
}

} // namespace stimuli::head
