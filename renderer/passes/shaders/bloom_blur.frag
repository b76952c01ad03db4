// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// One 1D Gaussian of the bloom, pairs of texels fetched at once by the sampler.
layout(binding = 0) uniform sampler2D source;
uniform vec2 axis;
uniform float sigma_px;

layout(location = 0) out vec4 blurred;

void main() {
    vec2 texel = 1.0 / vec2(textureSize(source, 0));
    vec4 sum = texture(source, gl_FragCoord.xy * texel);
    float total = 1.0;
    int reach = int(ceil(3.0 * sigma_px));
    for (int i = 1; i <= reach; i += 2) {
        float near = exp(-0.5 * float(i * i) / (sigma_px * sigma_px));
        float far = exp(-0.5 * float((i + 1) * (i + 1)) / (sigma_px * sigma_px));
        float weight = near + far;
        vec2 offset = axis * (float(i) + far / max(weight, 1e-30)); // both are 0 far out
        sum += weight * (texture(source, (gl_FragCoord.xy + offset) * texel) +
                         texture(source, (gl_FragCoord.xy - offset) * texel));
        total += 2.0 * weight;
    }
    blurred = sum / total;
}
