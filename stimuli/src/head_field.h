// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/glm.hpp>

#include "head_person.h"

namespace stimuli::head {

/// Roughly the distance to the skin of the head without its ears, in millimetres, negative inside.
float field(const Person& person, glm::vec3 place_mm);

/// Smooth union and intersection of two fields, rounded over `width_mm`.
float join(float a, float b, float width_mm);
float carve(float a, float b, float width_mm);

/// Field of a capsule whose radius runs from one end to the other.
float capsule(glm::vec3 place, glm::vec3 from, glm::vec3 to, float from_radius, float to_radius);
/// Field of an ellipsoid.
float ellipsoid(glm::vec3 place, glm::vec3 centre, glm::vec3 radii);

/// Soft tissue added to the skull's field: brows, cheeks, nose, eyes, mouth, chin. `place` has x >= 0.
float add_face(const Person& person, float skull, glm::vec3 place);

} // namespace stimuli::head
