// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include <renderer/passes/pipeline.h>
#include <renderer/scene/camera.h>
#include <study/protocol.h>

#include "design.h"

namespace stimuli {

/// What the renderer needs for one image, and the same as plain data.
struct Recipe {
    std::optional<renderer::passes::Shader> shader; ///< nothing: the reference
    renderer::scene::Camera camera;
    renderer::passes::Light light;
    nlohmann::ordered_json parameters; ///< every parameter the image depends on, for the manifest
    std::string digest; ///< SHA-256 of the parameters: the image is up to date while it is the same
};

/// The recipe of one image. `driver` names the OpenGL renderer, on which the last bits of an image depend.
Recipe recipe(const Item& item, const study::Protocol& protocol, const renderer::scene::Model& model,
              const renderer::scene::HeadFrame& head, const std::string& driver);

} // namespace stimuli
