// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "vertex_inputs.glsl"

uniform mat4 light_from_world;

void main() { gl_Position = light_from_world * vec4(position_mm, 1.0); }
