// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "screen_surface.glsl"

// A kernel of few taps on the screen, turned by a random angle at each pixel [Jimenez2009, section 4].
// EARLY_TEST is defined by the program.
layout(binding = 0) uniform sampler2D source; // rgb times matte, matte
uniform int tap_count;
uniform vec2 tap_offsets_mm[49];
uniform vec3 tap_weights[49];

layout(location = 0) out vec4 scattered;

// A well-mixed number in [0, 1) for each pixel: the PCG hash [JarzynskiOlano2020].
float random(uvec2 pixel) {
    uint state = (pixel.x + pixel.y * 65536u) * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    word = (word >> 22u) ^ word;
    return float(word >> 8u) / 16777216.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(shape_map, pixel, 0);
#if !EARLY_TEST
    if (surface.x <= 0.0) {
        discard;
    }
#endif
    vec3 shape = surface.yzw;
    mat2 px_per_mm = mat2(shape.x, 0.0, shape.z * shape.y, shape.y);
    float angle = 6.28318530717959 * random(uvec2(pixel));
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec2 texel = 1.0 / vec2(textureSize(source, 0));
    vec3 sum = vec3(0.0);
    vec3 met = vec3(0.0);
    for (int i = 0; i < tap_count; ++i) {
        vec2 offset_px = clamp(px_per_mm * (turn * tap_offsets_mm[i]), -widest_px, widest_px);
        vec4 tap = textureLod(source, (gl_FragCoord.xy + offset_px) * texel, 0.0);
        sum += tap_weights[i] * tap.rgb;
        met += tap_weights[i] * tap.a;
    }
    // Where no tap met skin, the light stays where it is.
    vec3 here = texelFetch(source, pixel, 0).rgb;
    scattered = vec4(mix(here, sum / max(met, vec3(1e-4)), step(1e-4, met)), 1.0);
}
