// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/glm.hpp>

#include <renderer/scene/model.h>

namespace renderer::scene {

/// A pinhole camera, millimetres.
struct Camera {
    glm::vec3 eye_mm{0}, target_mm{0};
    float fov_rad = 0.35f; ///< vertical
    int width = 0, height = 0;

    /// Directions from world to view; the camera looks along -Z of the view, +Y up.
    glm::mat3 rotation() const;
    /// View to clip: x and y as usual, depth reversed, from 1 at a plane just before the bounds to 0 at
    /// infinity.
    glm::mat4 projection(const Bounds& scene) const;
    /// Pixels per millimetre of a facing surface at a depth of 1 mm: (height / 2) cot(fov / 2).
    float focal_px() const;

    bool operator==(const Camera&) const = default;
};

/// The part of a model that is the head.
struct HeadFrame {
    glm::vec3 centre_mm{0};
    float height_mm = 232; ///< chin to vertex
};

/// The top `height_mm` of the model: centre is the middle of that part's bounds, half the height below the
/// vertex.
HeadFrame top_of(const Model& model, float height_mm);

/// A camera in front of the face that looks at the head's centre from `distance_mm`.
Camera facing(const HeadFrame& head, float distance_mm, float fov_rad, int width, int height);

/// Unit vector towards a light. Azimuth 0 is in front of the face (+Z) and turns about +Y; elevation is above
/// the horizontal plane.
glm::vec3 light_direction(float azimuth_rad, float elevation_rad);

} // namespace renderer::scene
