// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include <measure/picture.h>
#include <renderer/scene/frame.h>

namespace measure {

/// A rendered frame with linear light, to be measured.
Picture picture_of(const renderer::scene::Frame& frame, const std::string& name);

/// Refuse an image that is not finite everywhere, or shows another silhouette than its reference, before
/// anything about it is believed. Throws support::Failure.
void check_sound(const Picture& image, const Picture& truth);

} // namespace measure
