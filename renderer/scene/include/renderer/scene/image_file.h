// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include <renderer/scene/model.h>

namespace renderer::scene {

/// Decode a PNG, JPEG or other file that OpenImageIO reads, to 8 bits and 3 or 4 channels (alpha not
/// associated). Throws support::InputError.
ImagePtr read_image(const std::filesystem::path& file);

/// The same from memory; `name` stands in errors.
ImagePtr decode_image(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace renderer::scene
