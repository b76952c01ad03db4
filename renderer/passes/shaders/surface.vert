// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "vertex_inputs.glsl"

uniform mat4 view_from_world;
uniform mat4 clip_from_view;

// Centroid: where a pixel is covered in part, values come from inside the triangle, not from beyond its edge.
out Surface {
    centroid vec3 position_mm;
    centroid vec3 normal;
    centroid vec4 tangent;
    centroid vec2 uv;
    centroid float depth_mm;
} surface;

void main() {
    vec4 view_mm = view_from_world * vec4(position_mm, 1.0);
    surface.position_mm = position_mm;
    surface.normal = normal;
    surface.tangent = tangent;
    surface.uv = uv;
    surface.depth_mm = -view_mm.z;
    gl_Position = clip_from_view * view_mm;
}
