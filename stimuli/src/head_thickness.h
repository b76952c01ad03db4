// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <renderer/scene/model.h>

namespace stimuli::head {

constexpr float most_thickness_mm = 40; ///< beyond this no light comes through

/// How far light travels through the flesh below each vertex before it leaves again, in millimetres: the
/// harmonic mean over directions inward, so that a thin way counts more than a long one; most_thickness_mm at
/// most.
std::vector<float> thickness_mm(const renderer::scene::Mesh& mesh);

/// The same as a map over the mesh's UVs, which are a grid's: green is the thickness over most_thickness_mm.
renderer::scene::Image thickness_map(const renderer::scene::Mesh& mesh);

} // namespace stimuli::head
