// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <vector>

#include <tiny_gltf.h>

#include <renderer/scene/gltf.h>

#include "gltf_accessor.h"

namespace renderer::scene {

/// The one extension that is read.
constexpr const char* specular_extension = "KHR_materials_specular";

/// All materials of a parsed file, images decoded, overrides applied; one more at the end for primitives that
/// name none. Throws support::InputError that names the field.
std::vector<Material> read_materials(const tinygltf::Model& source, const AccessorReader& reader,
                                     const std::filesystem::path& file, const ModelOverrides& overrides);

} // namespace renderer::scene
