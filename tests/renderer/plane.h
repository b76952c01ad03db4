// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/passes/pipeline.h>
#include <renderer/scene/model.h>

/// Scenes with known answers, for tests that render.
namespace scenes {

/// A square in the plane z = 0, `side_mm` long, facing +Z, its middle at the origin, UVs over all of it.
renderer::scene::Model plane(float side_mm);

/// The plane with a base colour of 1 where x < 0 and (almost) 0 elsewhere.
renderer::scene::Model half_white_plane(float side_mm);

/// Turn a model about the y axis.
void turn(renderer::scene::Model& model, float angle_rad);

/// A sphere about the origin, split finely, UVs by longitude and latitude.
renderer::scene::Model sphere(float radius_mm);

/// Nothing but diffuse light and scattering: no specular, no bloom, all colour applied before scattering.
renderer::passes::Look diffuse_look();

/// A light along +Z that gives white surfaces facing it the radiance 1.
renderer::passes::Light frontal_light();

/// A camera on the z axis that looks at the origin, 20 degrees.
renderer::scene::Camera camera(float distance_mm, int width, int height);

/// The linear RGBA value of a pixel, row 0 at the top.
glm::vec4 value(const renderer::passes::Frame& frame, int x, int y);

} // namespace scenes
