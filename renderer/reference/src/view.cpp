// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "view.h"

#include <algorithm>
#include <cmath>

namespace renderer::reference {
namespace {

// What lies nearer than this share of the farthest distance is cut away, as in scene::Camera::projection().
constexpr double nearest_share = 1e-7;

} // namespace

View::View(const scene::Camera& camera, const Geometry& geometry)
    : eye_mm_(glm::dvec3(camera.eye_mm) - geometry.origin_mm()),
      focal_px_(static_cast<double>(camera.focal_px())), width_(camera.width), height_(camera.height) {
    const glm::dmat3 world_from_view = glm::transpose(glm::dmat3(camera.rotation()));
    right_ = world_from_view[0];
    up_ = world_from_view[1];
    forward_ = -world_from_view[2];
    const scene::Bounds& bounds = geometry.bounds();
    const glm::dvec3 farthest =
        glm::max(glm::abs(glm::dvec3(bounds.low) - eye_mm_), glm::abs(glm::dvec3(bounds.high) - eye_mm_));
    near_mm_ = nearest_share * glm::length(farthest);
}

Ray View::ray(const glm::dvec2& place_px) const {
    const glm::dvec3 v =
        forward_ * focal_px_ + right_ * (place_px.x - 0.5 * width_) + up_ * (0.5 * height_ - place_px.y);
    const double length = glm::length(v);
    return {eye_mm_, v / length, near_mm_ * length / focal_px_, 1e30};
}

double View::depth_mm(const glm::dvec3& position_mm) const {
    return std::max(glm::dot(position_mm - eye_mm_, forward_), near_mm_);
}

std::vector<glm::dvec2> pixel_pattern(int side) {
    // The canonical arrangement of correlated multi-jittered sampling [Kensler2013], without the jitter.
    std::vector<glm::dvec2> places;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            places.emplace_back((i + (j + 0.5) / side) / side, (j + (i + 0.5) / side) / side);
        }
    }
    return places;
}

} // namespace renderer::reference
