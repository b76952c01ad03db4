// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace stimuli::head {

/// What colours skin.
struct Pigment {
    float melanin = 0; ///< share of the epidermis that is melanosomes
    float blood = 0;   ///< share of the dermis that is blood
};

constexpr double face_epidermis_mm = 0.06, lip_epidermis_mm = 0.02; ///< of living cells above the blood
constexpr float most_melanin = 0.5F, most_blood = 0.16F;

/// Diffuse reflectance of skin as linear Rec. 709 under D65: an epidermis that absorbs by its melanin over a
/// dermis that absorbs by its blood, below a horny layer that absorbs nothing. Absorption and scattering
/// spectra are those of Donner and Jensen's model [DonnerJensen2006]; the dermis reflects as the dipole says
/// [Jensen2001].
glm::vec3 skin_colour_exact(const Pigment& pigment, double epidermis_mm = face_epidermis_mm);

/// The same, from a table, to a 1/500.
class SkinColours {
public:
    explicit SkinColours(double epidermis_mm = face_epidermis_mm);
    glm::vec3 operator()(const Pigment& pigment) const;

private:
    std::vector<glm::vec3> table_;
};

} // namespace stimuli::head
