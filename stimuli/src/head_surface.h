// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>
#include <renderer/scene/model.h>

#include "head_person.h"

namespace stimuli::head {

/// The head's surface over the unit square: u runs around it from the back over the subject's right side, the
/// face (u = 1/2) and the left side to the back again, v from the vertex down to the floor below the
/// shoulders. A grid of places, evenly spaced in u and v; its first and last columns are the same places.
struct Surface {
    int columns = 0, rows = 0;       ///< cells
    std::vector<glm::vec3> place_mm; ///< (columns + 1) x (rows + 1), row by row

    const glm::vec3& at(int column, int row) const {
        return place_mm[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) +
                        static_cast<std::size_t>(column)];
    }
};

/// The head with its ears.
Surface head_surface(const Person& person);

/// The surface as triangles with normals and tangents that agree across the seam.
renderer::scene::Mesh head_mesh(const Surface& surface);

/// Move a place near the root of an ear out to the ear's skin; other places stay.
glm::vec3 add_ear(glm::vec3 place_mm);

} // namespace stimuli::head
