// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <glm/glm.hpp>

#include <renderer/scene/camera.h>

#include "geometry.h"

namespace renderer::reference {

/// A camera's rays, among the places of a geometry.
class View {
public:
    View(const scene::Camera& camera, const Geometry& geometry);

    int width() const { return width_; }
    int height() const { return height_; }
    const glm::dvec3& eye_mm() const { return eye_mm_; }
    double near_mm() const { return near_mm_; }
    /// Through a place of the image in pixels, (0, 0) at its upper left corner; starts at the near plane.
    Ray ray(const glm::dvec2& place_px) const;
    /// Distance along the viewing axis, at least that of the near plane.
    double depth_mm(const glm::dvec3& position_mm) const;
    /// Length of a pixel's side on a facing surface.
    double footprint_mm(double depth_mm) const { return depth_mm / focal_px_; }

private:
    glm::dvec3 eye_mm_{0}, right_{0}, up_{0}, forward_{0};
    double focal_px_ = 0, near_mm_ = 0;
    int width_ = 0, height_ = 0;
};

/// Places in the unit square, `side` squared: one in each square of a grid, and one in each of as many
/// columns and rows, as far as they can be even.
std::vector<glm::dvec2> pixel_pattern(int side);

} // namespace renderer::reference
