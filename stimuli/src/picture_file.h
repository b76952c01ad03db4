// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

#include <renderer/passes/pipeline.h>

namespace stimuli {

/// Write the 8-bit sRGB image as PNG, whole or not at all, and give its SHA-256. Throws support::Failure.
std::string write_png(const std::filesystem::path& file, const renderer::passes::Frame& frame);

/// Write the linear image as half-float EXR (RGBA, linear Rec. 709; A is the head's coverage); otherwise as
/// write_png.
std::string write_exr(const std::filesystem::path& file, const renderer::passes::Frame& frame);

} // namespace stimuli
