// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <span>

#include <measure/picture.h>

namespace measure {

/// Write a map of values in [0, 1] as an 8-bit PNG, from black over purple, red and yellow to white: a
/// cubehelix [Green2011], whose brightness rises steadily with the value. Throws support::Failure.
void write_error_map(const std::filesystem::path& file, std::span<const float> values, int width, int height);

/// Write |image - reference| of the display signals times the gain, cut off at white, as an 8-bit PNG. Throws
/// support::Failure.
void write_difference(const std::filesystem::path& file, const Picture& image, const Picture& reference,
                      double gain);

} // namespace measure
