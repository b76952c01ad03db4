// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include <renderer/scene/model.h>

#include "gpu_model.h"

namespace renderer::passes {

/// How the meshes of one material lie in a square map, whatever its size.
struct UvLayout {
    std::vector<std::size_t> meshes;                ///< their numbers in the model
    glm::vec2 uv_origin{0}, uv_scale{1};            ///< bring texture coordinates into the unit square
    float side_mm = 0;                              ///< of the map, if spread over the surface evenly
    std::vector<std::vector<glm::vec2>> map_per_mm; ///< [mesh][triangle]: share of the map's sides, at most
};

UvLayout uv_layout(const scene::Model& model, std::size_t material);

/// Whether both materials' meshes are copies of each other but for their place and turn, so that they lie
/// alike in their maps: the same triangles, texture coordinates, and lengths of edges.
bool lie_alike(const scene::Model& model, const UvLayout& a, const UvLayout& b);

/// Blocks along the side of a map of a size, to decide on all texels of a block at once.
int blocks_along(int size);

/// Which blocks of a layout's map of a size a view needs, row by row: those with triangles that face the
/// camera and lie in its frustum, and those from which light reaches them, within `margin_mm`. The camera is
/// given in the world, as the source is.
std::vector<std::uint8_t> wanted_blocks(const scene::Model& source, const GpuModel::View& view,
                                        const scene::Camera& camera, const UvLayout& layout, int size,
                                        float margin_mm);

} // namespace renderer::passes
