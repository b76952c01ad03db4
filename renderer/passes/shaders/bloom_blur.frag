// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// One 1D Gaussian of the bloom. The k-th tap to both sides weighs ratio^(k^2), which takes two products a tap.
layout(binding = 0) uniform sampler2D source;
uniform ivec2 axis;
uniform float sigma_px;

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(source, 0) - 1;
    vec4 sum = texelFetch(source, pixel, 0);
    float total = 1.0;
    int reach = int(ceil(3.0 * sigma_px));
    float ratio = exp(-0.5 / (sigma_px * sigma_px));
    float next_ratio = ratio; // ratio^(2k - 1)
    float weight = 1.0;
    for (int k = 1; k <= reach; ++k) {
        weight *= next_ratio;
        next_ratio *= ratio * ratio;
        sum += weight * (texelFetch(source, min(pixel + k * axis, last), 0) +
                         texelFetch(source, max(pixel - k * axis, ivec2(0)), 0));
        total += 2.0 * weight;
    }
    blurred = sum / total;
}
