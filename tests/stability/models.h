// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/scene/model.h>
#include <support/random.h>

/// Models for trying the renderer, and ways to spoil them. Lengths in millimetres.
namespace stability {

/// A square in the plane z = 0 about the origin, facing +Z, UVs over all of it, `cells` squared pairs of
/// triangles.
renderer::scene::Model square(float side_mm, int cells);

/// A sphere about the origin, UVs by longitude and latitude, dented by waves of `dent` of its radius.
renderer::scene::Model dented_sphere(float radius_mm, float dent, int columns, int rows);

/// Two squares that face +Z, the smaller before the larger: a gap in depth inside the silhouette. They stand
/// aslant, so that no whole edge falls on the border between two rows of pixels or texels.
renderer::scene::Model step(float side_mm, float gap_mm);

/// Triangles anywhere in a cube, facing anywhere, some of them without an area.
renderer::scene::Model soup(float side_mm, int triangles, support::Generator& random);

/// An image of independent random bytes.
renderer::scene::ImagePtr noise_image(int width, int height, support::Generator& random);

/// What files in the wild do to a mesh.
enum class Damage {
    none,
    zero_normals,     ///< some normals are zero
    opposite_normals, ///< some normals are the opposite of their neighbours'
    zero_tangents,
    degenerate_triangles, ///< some triangles have no area
    collapsed_uvs,        ///< some triangles have all corners at one place of the texture
    one_uv,               ///< all of them
    far_uvs,              ///< texture coordinates in the millions
    missing_uvs,
};
constexpr int damages = 9;
const char* name(Damage damage);

/// Damage a share of a model's vertices or triangles.
void spoil(renderer::scene::Model& model, Damage damage, support::Generator& random);

} // namespace stability
