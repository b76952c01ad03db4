// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Hable's 13 taps [Hable2009] on the screen, turned by a random angle at each pixel [Jimenez2009, section 4].
layout(binding = 0) uniform sampler2D source; // rgb times matte, matte
layout(binding = 1) uniform sampler2D stretch_map; // pixels per millimetre, 0 where there is no skin
uniform float widest_px; // bound of a kernel's step, for depths near 0
uniform vec2 tap_offsets_mm[13];
uniform vec3 tap_weights[13];

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
    vec2 px_per_mm = texelFetch(stretch_map, pixel, 0).xy;
    if (px_per_mm.x <= 0.0) {
        scattered = vec4(0.0);
        return;
    }
    float angle = 6.28318530717959 * random(uvec2(pixel));
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec2 texel = 1.0 / vec2(textureSize(source, 0));
    vec3 sum = vec3(0.0);
    vec3 met = vec3(0.0);
    for (int i = 0; i < 13; ++i) {
        vec2 offset_px = clamp(turn * tap_offsets_mm[i] * px_per_mm, -widest_px, widest_px);
        vec4 tap = textureLod(source, (gl_FragCoord.xy + offset_px) * texel, 0.0);
        sum += tap_weights[i] * tap.rgb;
        met += tap_weights[i] * tap.a;
    }
    scattered = vec4(sum / max(met, vec3(1e-4)), 1.0);
}
