// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "head_person.h"

namespace stimuli::head {

/// The hairs of brows and lashes, one by one, seen from the front.
class Hairs {
public:
    explicit Hairs(const Person& person);

    struct Cover {
        float share, grey; ///< of the spot, 0 to 1: covered by hair, and by hair that has lost its colour
    };
    /// How much of a spot is covered by hair. `folded` is the place on the half head, `side` the sign of the
    /// place's x, `spot_mm` how wide the spot is.
    Cover cover(glm::vec3 folded, float side, float spot_mm) const;

private:
    struct Hair {
        std::array<glm::vec2, 4> line; ///< from root to tip, mm
        float radius_mm;
        bool grey;
    };
    void add(const Hair& hair, float side);
    void add_brow(const Person& person, float side);
    void add_lashes(const Person& person, float side);

    std::vector<Hair> hairs_;
    std::vector<std::vector<int>> bins_; ///< hairs that come near each square of the face
};

} // namespace stimuli::head
