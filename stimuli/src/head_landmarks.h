// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

/// Where things are in the built-in head. Millimetres; x to the subject's left, y = 0 at the eyes, z forward.
/// Curves are functions of |x|, for the head is symmetric before its asymmetry is added.
namespace stimuli::head {

constexpr float vertex_y = 116, chin_y = -116; ///< 232 mm apart, the eyes half way
constexpr glm::vec3 eye_centre{30.4F, -1.4F, 69.0F};
constexpr float eye_radius = 12.4F;
constexpr float eye_inner_x = 16.5F, eye_outer_x = 46.0F;
constexpr glm::vec3 nose_tip{0, -32.2F, 106.8F};
constexpr float mouth_half_width = 23.8F;
constexpr float ear_tilt = 0.20F; ///< the ear's long axis leans back, radians
constexpr glm::vec3 ear_root{71, -17, -13};

/// 0 below `low`, 1 above `high`, smooth between; falls when low > high.
inline float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

inline float square(float x) { return x * x; }

/// exp(-(x / width)^2).
inline float bell(float x, float width) { return std::exp(-square(x / width)); }

/// Along the eye: 0 at the inner corner, 1 at the outer.
inline float along_eye(float x) { return (x - eye_inner_x) / (eye_outer_x - eye_inner_x); }

/// 1 at the middle of the interval [0, 1], 0 at and beyond its ends.
inline float arch(float s) { return std::max(0.0F, 4 * s * (1 - s)); }

/// Height of the line where the closed lids meet.
inline float lid_line_y(float x) {
    const float s = along_eye(x);
    return -3.0F + 2.6F * s - 4.6F * arch(s);
}

/// Height of the fold of the upper lid.
inline float lid_fold_y(float x) {
    const float s = along_eye(x);
    return -0.8F + 2.2F * s + 5.6F * std::pow(arch(s), 0.8F);
}

/// Height of the brow's middle: rising to an arch at two thirds, then falling.
inline float brow_y(float x) {
    const float s = (x - 9) / 48;
    return 13.0F + 4.6F * s + 2.4F * arch(s) - 5.5F * square(std::max(s - 0.55F, 0.0F) / 0.45F);
}

/// Heights of the upper lip's edge (with Cupid's bow), of the line between the lips, and of the lower lip's
/// edge.
inline float lip_top_y(float x) {
    const float s = std::min(x / mouth_half_width, 1.0F);
    return -62.2F - 6.9F * std::pow(s, 1.4F) + 1.4F * bell(x - 5.5F, 4.0F);
}
inline float lip_line_y(float x) {
    const float s = std::min(x / mouth_half_width, 1.0F);
    return -69.2F + 1.3F * square(std::sin(2.0F * s)) - 1.5F * s;
}
inline float lip_bottom_y(float x) {
    const float s = std::min(x / mouth_half_width, 1.0F);
    return -69.6F - 8.8F * std::pow(1 - s * s, 1.1F);
}

} // namespace stimuli::head
