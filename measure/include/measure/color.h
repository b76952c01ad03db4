// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <glm/glm.hpp>

namespace measure {

/// Linear Rec. 709 to CIE XYZ: the primaries [IEC1999] at the white D65, x = 0.31271, y = 0.32902.
const glm::dmat3& xyz_from_linear();

/// A colour of CIE 1976 L*a*b*, in that order; white is D65 [CIE2004].
glm::dvec3 lab_from_linear(const glm::dvec3& linear);

/// The CIEDE2000 difference of two colours of L*a*b*, all parametric factors 1 [Sharma2005, Eqs. 2-22].
double ciede2000(const glm::dvec3& first_lab, const glm::dvec3& second_lab);

} // namespace measure
