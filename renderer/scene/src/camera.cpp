// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <renderer/scene/camera.h>

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace renderer::scene {

glm::mat4 Camera::view() const { return glm::lookAt(eye_mm, target_mm, glm::vec3(0, 1, 0)); }

glm::mat4 Camera::projection(const Bounds& scene) const {
    // The corners' depths along the viewing axis bound those of the scene.
    const glm::vec3 axis = glm::normalize(target_mm - eye_mm);
    float nearest = 1e30f;
    float farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1) ? scene.low.x : scene.high.x,
                          (corner & 2) ? scene.low.y : scene.high.y,
                          (corner & 4) ? scene.low.z : scene.high.z);
        const float depth = glm::dot(p - eye_mm, axis);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const float far_mm = std::max(farthest * 1.01f, 1.0f);
    const float near_mm = std::clamp(nearest * 0.99f, far_mm * 1e-4f, far_mm * 0.999f);
    return glm::perspective(fov_rad, static_cast<float>(width) / static_cast<float>(height), near_mm, far_mm);
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
