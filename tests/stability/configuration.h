// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include <support/random.h>

#include "case.h"

/// Seeded random configurations: the same index gives the same configuration everywhere.
namespace stability {

/// Anything that the interfaces allow, however unlikely: damaged models of 0.1 mm to 100 m, some 10 km away,
/// seen from inside or from 100 m, in light of 1e-6 to 1e6, with kernels up to a metre wide and images of one
/// pixel. Up to three lights.
Case hostile(std::uint64_t index);

/// What studies render, in small: an object of 10 cm, well in view, lit to about white, with settings that
/// vary.
Case ordinary(std::uint64_t index);

/// A white square that fills some of the image, tilted, under even light without gloss or bloom: each shader
/// must show it in `even_light(given)`.
Case even(std::uint64_t index);
glm::vec3 even_light(const Case& given);
/// The light of a white surface that faces both the light and the sky.
glm::vec3 white_level(const Case& given);

/// A white patch in the middle of a black square that faces the camera, with kernels that keep its light in
/// the image.
Case patch(std::uint64_t index);

/// A random number whose logarithm is uniform.
double log_uniform(support::Generator& random, double low, double high);

} // namespace stability
