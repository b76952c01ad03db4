// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/scene/model.h>
#include <study/protocol.h>

namespace stimuli {

constexpr float screen_grey = 0.2f; ///< albedo

/// The model as the protocol's scene has it: copies of it side by side, each with materials of its own, so
/// that texture space gives each a map of its own; a screen before them. Marks what is not skin. Throws
/// support::InputError if the protocol names a material that the model lacks.
renderer::scene::Model arranged(renderer::scene::Model model, const study::Protocol& protocol);

} // namespace stimuli
