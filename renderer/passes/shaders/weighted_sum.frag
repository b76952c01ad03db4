// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The profile as a weighted sum of its Gaussians [Jimenez2009, section 4].
layout(binding = 0) uniform sampler2D gaussian_maps[6]; // profiles have at most six Gaussians
uniform vec3 weights[6];
uniform int count;

layout(location = 0) out vec4 scattered;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; ++i) {
        vec4 g = texelFetch(gaussian_maps[i], pixel, 0);
        sum += vec4(weights[i] * g.rgb, g.a / float(count));
    }
    scattered = sum;
}
