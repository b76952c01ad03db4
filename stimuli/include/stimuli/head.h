// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <renderer/scene/model.h>

namespace stimuli {

/// The head that is used when no model is given: closed lids, no hair, neck and shoulders.
/// Millimetres, 232 mm from chin to vertex, the eyes at half that height at y = 0, the face along +Z.
/// One watertight mesh, one chart with its seam at the back, 1024 x 1024 maps (albedo, normal, roughness).
/// The same on every call; about a second of work.
renderer::scene::Model builtin_head();

} // namespace stimuli
