// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Bring the scattered light from texture space to the screen.
#include "surface.glsl"

layout(binding = 0) uniform sampler2D scattered_map; // the weighted sum of the Gaussians that are blurred in maps
layout(binding = 6) uniform sampler2D lit_map;       // the lit frame; units 0 to 2 are the material's
uniform vec3 weight_in_maps; // of those Gaussians together
uniform bool is_skin;
uniform vec2 uv_origin;
uniform vec2 uv_scale;

layout(location = 0) out vec4 scattered;

void main() {
    vec4 light = texture(scattered_map, (surface_uv() - uv_origin) * uv_scale);
    // What has no place in the map, as its triangles have no area there, is left unscattered.
    vec3 unscattered = weight_in_maps * texelFetch(lit_map, ivec2(gl_FragCoord.xy), 0).rgb;
    scattered = is_skin ? vec4(light.a > 1e-3 ? light.rgb / light.a : unscattered, 1.0) : vec4(0.0);
}
