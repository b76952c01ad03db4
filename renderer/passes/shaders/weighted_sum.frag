// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The unblurred light and all Gaussians, each from a target of its own, summed [Jimenez2009].
layout(binding = 0) uniform sampler2D lights[7]; // profiles have at most six Gaussians
uniform vec3 weights[7];
uniform int count;

layout(location = 0) out vec4 scattered;

void main() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        sum += weights[i] * texelFetch(lights[i], ivec2(gl_FragCoord.xy), 0).rgb;
    }
    scattered = vec4(sum, 1.0);
}
