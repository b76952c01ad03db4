// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/scene/camera.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

namespace renderer::scene {

// What lies nearer than this share of the farthest depth is cut away. Reversed depth in floats tells depths
// apart to 1e-7 of their size, however near the plane lies.
constexpr float nearest_share = 1e-7f;

glm::mat3 Camera::rotation() const {
    // In double precision, as eye and target may lie close together far from the origin.
    const glm::dvec3 towards = glm::dvec3(target_mm) - glm::dvec3(eye_mm);
    const double distance_mm = glm::length(towards);
    const glm::dvec3 axis = distance_mm > 0 ? towards / distance_mm : glm::dvec3(0, 0, -1);
    // Looking straight up or down, any other direction may be up.
    const bool vertical = glm::length(glm::cross(axis, glm::dvec3(0, 1, 0))) < 1e-6;
    const glm::dvec3 up = vertical ? glm::dvec3(0, 0, axis.y) : glm::dvec3(0, 1, 0);
    return glm::mat3(glm::lookAt(glm::dvec3(0), axis, up));
}

glm::mat4 Camera::projection(const Bounds& scene) const {
    // The corners' depths along the viewing axis bound those of the scene.
    const glm::mat3 turn = rotation();
    float nearest = std::numeric_limits<float>::infinity();
    float farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? scene.low.x : scene.high.x,
                          (corner & 2) ? scene.low.y : scene.high.y,
                          (corner & 4) ? scene.low.z : scene.high.z);
        const float depth = -(turn * (p - eye_mm)).z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const float near_mm = farthest > 0 ? std::max(nearest * 0.99f, farthest * nearest_share) : 1.0f;
    const float cotangent = 1 / std::tan(0.5f * fov_rad);
    glm::mat4 result(0);
    result[0][0] = cotangent * static_cast<float>(height) / static_cast<float>(width);
    result[1][1] = cotangent;
    result[3][2] = near_mm;
    result[2][3] = -1;
    return result;
}

float Camera::focal_px() const { return 0.5f * static_cast<float>(height) / std::tan(0.5f * fov_rad); }

HeadFrame top_of(const Model& model, float height_mm) {
    const float vertex_mm = bounds(model).high.y;
    const Bounds head = bounds_above(model, vertex_mm - height_mm);
    const glm::vec3 middle = 0.5f * (head.low + head.high);
    return {{middle.x, vertex_mm - 0.5f * height_mm, middle.z}, height_mm};
}

Camera facing(const HeadFrame& head, float distance_mm, float fov_rad, int width, int height) {
    return {head.centre_mm + glm::vec3(0, 0, distance_mm), head.centre_mm, fov_rad, width, height};
}

glm::vec3 light_direction(float azimuth_rad, float elevation_rad) {
    return {std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad),
            std::cos(elevation_rad) * std::cos(azimuth_rad)};
}

} // namespace renderer::scene
