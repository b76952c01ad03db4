// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>

#include <renderer/scene/model.h>

namespace stimuli {

/// Whose head it is. The default is the head that is used when no model is given.
struct HeadSettings {
    std::uint64_t seed = 0;  ///< which person: proportions, asymmetry, pores, freckles
    double age_years = 45;   ///< 18 to 90: wrinkles, sagging, spots, grey brows
    double melanin = 0.0225; ///< share of the epidermis that is melanosomes, 0 to 0.5
};

/// How many of the triangles are kept.
enum class HeadDetail { full, fifth, tenth };

/// A head sculpted by code: closed lids, no hair, neck and shoulders.
/// Millimetres, 232 mm from chin to vertex, the eyes at half that height at y = 0, the face along +Z.
/// One watertight mesh, one chart with its seam at the back, 2048 x 2048 maps (albedo, normal, reflection).
/// The same on every call. Some seconds of work, kept in the user's cache folder ($XDG_CACHE_HOME/skin2afc or
/// ~/.cache/skin2afc) where there is one.
renderer::scene::Model builtin_head(const HeadSettings& settings = {});

/// The same without the cache.
renderer::scene::Model sculpt_head(const HeadSettings& settings);

/// The head with fewer triangles; vertices that stay keep all they have, and the seam stays closed.
renderer::scene::Model simplified(const renderer::scene::Model& head, HeadDetail detail);

/// Write the head as binary glTF 2.0: metres, maps as PNG, the strength of the reflection as
/// KHR_materials_specular, the thickness of the flesh below each place as KHR_materials_volume. Replaces the
/// file in one step. Throws support::Failure.
void write_head(const renderer::scene::Model& head, const std::filesystem::path& file);

} // namespace stimuli
