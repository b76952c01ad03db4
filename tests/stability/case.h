// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <renderer/passes/pipeline.h>

/// All that one image depends on, and changes to it that must not show, or must show in a known way.
namespace stability {

struct Case {
    std::string name; ///< how to make it again
    renderer::scene::Model model;
    renderer::passes::Look look;
    renderer::passes::Methods methods;
    renderer::passes::Light light;
    renderer::scene::Camera camera;
};

/// Every length times `factor`: model, camera, profile, shadow and kernel.
Case scaled(Case given, double factor);
/// The mirror image in the plane x = 0.
Case mirrored(Case given);
/// Model, camera and light turned about the vertical through the origin, the axis of the ambient light.
Case turned(Case given, double angle_rad);
/// Model and camera moved.
Case moved(Case given, const glm::dvec3& by_mm);
/// Light times `factor`, exposure divided by it.
Case brightened(Case given, double factor);

/// A profile of one Gaussian that is the same for all colours.
renderer::optics::Profile gaussian(double sigma_mm);

} // namespace stability
