// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include <glm/glm.hpp>
#include <stimuli/head.h>

namespace stimuli::head {

/// What makes one head differ from another.
struct Person {
    explicit Person(const HeadSettings& settings);

    std::uint64_t seed;
    float melanin;  ///< share of the epidermis
    float age;      ///< 0 at 20 years, 1 at 70
    float wrinkled; ///< depth of lines, relative to that at 45 years
    float grey;     ///< share of hairs that are grey

    // Departures from the mean face, about -1 to 1.
    float nose_width = 0, nose_length = 0, mouth_width = 0, jaw_width = 0, brow_depth = 0, eye_distance = 0,
          cheek_width = 0;
    float lean_phase, tilt_phase; ///< of the asymmetry, radians

    /// The place on the mean head's right-left folded half (x >= 0) in which the features are described.
    glm::vec3 fold(glm::vec3 place_mm) const;
};

} // namespace stimuli::head
