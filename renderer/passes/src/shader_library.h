// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <string>

#include <renderer/gl/objects.h>

namespace renderer::passes {

/// Text of every embedded shader file by its name.
const std::map<std::string, std::string>& shader_sources();

/// Values that a fragment shader finds #defined.
using Defines = std::map<std::string, int>;

/// A program of one vertex and one fragment shader file. A line `#include "FILE"` stands for another embedded
/// file. Throws support::Failure that names file, stage and line.
gl::Program load_program(const std::string& vertex_file, const std::string& fragment_file,
                         const Defines& defines = {});

/// A program that runs `fragment_file` over the whole viewport.
gl::Program load_screen_program(const std::string& fragment_file, const Defines& defines = {});

/// Draw one triangle that covers the viewport, with any vertex array bound.
void draw_screen();

} // namespace renderer::passes
