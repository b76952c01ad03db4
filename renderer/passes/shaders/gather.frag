// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Bring the blurred irradiance maps from texture space to the screen: the weighted sum of the Gaussians.
#include "surface.glsl"

layout(binding = 0) uniform sampler2D gaussian_maps[6]; // profiles have at most six Gaussians
layout(binding = 6) uniform sampler2D lit_map; // the lit frame
uniform vec3 weights[6];
uniform int count; // 0: not skin
uniform vec2 uv_origin;
uniform vec2 uv_scale;

layout(location = 0) out vec4 scattered;

void main() {
    vec2 place = (surface_uv() - uv_origin) * uv_scale;
    // What has no place in the map, as its triangles have no area there, is left unscattered.
    vec3 unscattered = texelFetch(lit_map, ivec2(gl_FragCoord.xy), 0).rgb;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        vec4 g = texture(gaussian_maps[i], place);
        sum += weights[i] * (g.a > 1e-3 ? g.rgb / g.a : unscattered);
    }
    scattered = vec4(sum, count > 0 ? 1.0 : 0.0);
}
