// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <renderer/scene/frame.h>

namespace measure {

/// Refuse frames that are not finite, that are not the same twice, or that show what they should not. Both
/// with linear light. Throws support::Failure.
void check_same(const renderer::scene::Frame& first, const renderer::scene::Frame& second, bool empty,
                const std::string& name);

/// Refuse two frames that differ, as the scene hides what sets them apart. Throws support::Failure.
void check_hidden(const renderer::scene::Frame& first, const renderer::scene::Frame& other,
                  const std::string& name);

/// Pixels that show something of the model.
long long covered_pixels(const renderer::scene::Frame& frame);

} // namespace measure
