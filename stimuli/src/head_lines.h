// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/glm.hpp>

#include "head_noise.h"
#include "head_person.h"

namespace stimuli::head {

/// Depth in mm of the lines that expression and age leave, and of the creases at lids and mouth. `folded` is
/// the place on the half head, `place_mm` the place itself.
float lines_mm(const Person& person, const Noise& noise, glm::vec3 folded, glm::vec3 place_mm);

} // namespace stimuli::head
