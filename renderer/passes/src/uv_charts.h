// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include <renderer/scene/model.h>

namespace renderer::passes {

/// The chart of each triangle, numbered from 0: triangles are of one chart if they share a corner, that is a
/// place together with its texture coordinates.
std::vector<std::uint32_t> chart_of_triangle(const scene::Mesh& mesh);

/// A texel of a square map, or (-1, -1) for none.
struct Texel {
    std::int16_t x = -1, y = -1;
};

/// For each texel of a `size` x `size` map the nearest one (in steps to any of the eight neighbours) that is
/// covered, itself included, as long as it is at most `reach` steps away. `covered` is row by row.
std::vector<Texel> nearest_covered(const std::vector<bool>& covered, int size, int reach);

} // namespace renderer::passes
