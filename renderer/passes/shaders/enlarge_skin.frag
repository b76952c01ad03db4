// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Light from half the resolution: bilinear between those of the four pixels around that lie at about this depth.
layout(binding = 0) uniform sampler2D half_sum;
layout(binding = 1) uniform sampler2D depth_map;
layout(binding = 2) uniform sampler2D half_depth_map; // 0 where there is no skin
uniform float sigma_mm; // depths that differ by more belong to other surfaces

layout(location = 0) out vec4 sum_of_shares;

void main() {
    ivec2 last = textureSize(half_sum, 0) - 1;
    float depth = texelFetch(depth_map, ivec2(gl_FragCoord.xy), 0).r;
    vec2 place = 0.5 * gl_FragCoord.xy - 0.5;
    vec2 first = floor(place);
    vec2 f = place - first;
    vec3 sum = vec3(0.0);
    float met = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 pixel = clamp(ivec2(first) + corner, ivec2(0), last);
        float z = texelFetch(half_depth_map, pixel, 0).r;
        vec2 w = mix(1.0 - f, f, vec2(corner));
        float apart = (z - depth) / sigma_mm;
        float weight = z > 0.0 ? w.x * w.y / (1.0 + apart * apart) : 0.0;
        sum += weight * texelFetch(half_sum, pixel, 0).rgb;
        met += weight;
    }
    sum_of_shares = vec4(met > 0.0 ? sum / met : vec3(0.0), 1.0);
}
