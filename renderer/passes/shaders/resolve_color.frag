// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Resolve one colour whose alpha is its coverage: the mean over the covered samples.
layout(binding = 0) uniform sampler2DMS color_samples;
uniform int samples;

layout(location = 0) out vec4 color;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < samples; ++i) {
        sum += texelFetch(color_samples, ivec2(gl_FragCoord.xy), i);
    }
    color = sum.a > 0.0 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}
