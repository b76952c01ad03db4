// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// One 1D Gaussian over the skin on the screen. Taps beside the skin have matte 0 and take no part; the sum is
// divided by the matte it met, so that no background bleeds in.
layout(binding = 0) uniform sampler2D source; // rgb times matte, matte
layout(binding = 1) uniform sampler2D stretch_map; // pixels per millimetre, 0 where there is no skin
uniform float widest_px; // bound of a kernel's step, for depths near 0
uniform ivec2 axis;
uniform float sigma_mm;
uniform float taps[7]; // weights at -3 ... 3 standard deviations

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 px_per_mm = texelFetch(stretch_map, pixel, 0).xy;
    if (px_per_mm.x <= 0.0) {
        blurred = vec4(0.0);
        return;
    }
    float step_px = min(sigma_mm * dot(px_per_mm, vec2(axis)), widest_px);
    vec2 texel = 1.0 / vec2(textureSize(source, 0));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 7; ++i) {
        vec2 place = gl_FragCoord.xy + vec2(axis) * (float(i - 3) * step_px);
        sum += taps[i] * textureLod(source, place * texel, 0.0);
    }
    blurred = vec4(sum.rgb / sum.a, 1.0);
}
