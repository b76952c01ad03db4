// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>

#include <renderer/passes/pipeline.h>
#include <renderer/reference/reference.h>
#include <renderer/scene/camera.h>
#include <stimuli/head.h>
#include <study/protocol.h>

namespace stimuli {

/// The built-in head with so many of its triangles, as often as the protocol's scene has it, not rounded off.
renderer::scene::Model load_head(const study::Protocol& protocol, HeadDetail detail);

/// The model in `file`, else the protocol's, else the built-in head, rounded off as the protocol says. Throws
/// support::InputError.
renderer::scene::Model load_model(const study::Protocol& protocol,
                                  const std::optional<std::filesystem::path>& file);

/// From a protocol to the renderer's look and methods, the same for all images of a set.
renderer::passes::Look look(const study::Protocol& protocol);
renderer::passes::Methods methods(const study::Protocol& protocol);

/// The same for the shader `reference`, whose profile may be another.
renderer::passes::Look reference_look(const study::Protocol& protocol);
renderer::reference::Settings reference_settings(const study::Protocol& protocol);

/// The head in the model: by the protocol's word, else the model's top 232 mm.
renderer::scene::HeadFrame head_frame(const study::Protocol& protocol, const renderer::scene::Model& model);

/// A camera distance in millimetres, and the camera there.
double distance_mm(const study::Protocol& protocol, const study::Distance& distance);
renderer::scene::Camera camera(const study::Protocol& protocol, const study::Distance& distance,
                               const renderer::scene::HeadFrame& head);

/// The protocol's light at an azimuth.
renderer::scene::Light light(const study::Protocol& protocol, double azimuth_deg);

} // namespace stimuli
