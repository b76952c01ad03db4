// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>

#include <renderer/scene/model.h>

namespace renderer::scene {

/// What a model file leaves open or gets wrong.
struct ModelOverrides {
    std::optional<std::filesystem::path> base_color, normal, roughness; ///< images, in place of the file's
    double metres_per_unit = 1; ///< glTF's unit is the metre; scans often use another
    bool flip_v = false;        ///< the file's V runs from the image's bottom up
};

/// Load a glTF 2.0 model (.glb, .gltf): the default scene's triangles in millimetres, node transforms
/// applied, missing normals and tangents computed, images decoded. Cameras, lights, skins and morph targets
/// are left out. Throws support::InputError that says what in the file is missing, truncated or wrong.
Model load_gltf(const std::filesystem::path& file, const ModelOverrides& overrides = {});

} // namespace renderer::scene
