// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "vertex_inputs.glsl"

// Lay the mesh flat: its texture coordinates become the places in the map [DEonLuebke2007].
uniform vec2 uv_origin;
uniform vec2 uv_scale;

out Surface {
    centroid vec3 position_mm;
    centroid vec3 normal;
    centroid vec4 tangent;
    centroid vec2 uv;
    centroid float depth_mm;
    centroid float unity;
} surface;

void main() {
    surface.position_mm = position_mm;
    surface.normal = normal;
    surface.tangent = tangent;
    surface.uv = uv;
    surface.depth_mm = 0.0;
    surface.unity = 1.0;
    gl_Position = vec4((uv - uv_origin) * uv_scale * 2.0 - 1.0, 0.0, 1.0);
}
