// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "vertex_inputs.glsl"

uniform mat3 view_from_world;
uniform vec3 eye_mm;
uniform float beyond_mm; // farther than any place, which the compiler does not know
uniform mat4 clip_from_view;

// Centroid: where a pixel is covered in part, values come from inside the triangle, not from beyond its edge.
out Surface {
    centroid vec3 position_mm;
    centroid vec3 normal;
    centroid vec4 tangent;
    centroid vec2 uv;
    centroid float depth_mm;
    centroid float unity;
} surface;

void main() {
    // The difference is exact beside the camera, where a matrix that moves would lose it.
    vec3 view_mm = view_from_world * (position_mm - eye_mm);
    surface.position_mm = position_mm;
    surface.normal = normal;
    surface.tangent = tangent;
    surface.uv = uv;
    surface.depth_mm = -view_mm.z;
    surface.unity = position_mm.x < beyond_mm ? 1.0 : 0.0; // 1, but seen by the compiler as a value like others
    gl_Position = clip_from_view * vec4(view_mm, 1.0);
}
