// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include <glm/glm.hpp>
#include <renderer/scene/model.h>

namespace stimuli::head {

/// A place, mm, where an edge of a mesh passes through a triangle that it does not touch at a corner; none
/// where the mesh does not pass through itself. Vertices at the same place count as one.
std::optional<glm::vec3> crossing(const renderer::scene::Mesh& mesh);

} // namespace stimuli::head
