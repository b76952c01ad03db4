// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The skin at half the resolution: means over the pixels that are skin.
layout(binding = 0) uniform sampler2D source; // rgb, 0 where there is no skin
layout(binding = 1) uniform sampler2D depth_map; // 0 where there is no skin

layout(location = 0) out vec4 half_source;
layout(location = 1) out float half_depth_mm;

void main() {
    ivec2 last = textureSize(source, 0) - 1;
    vec3 light = vec3(0.0);
    vec2 depth = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = min(2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1), last);
        float z = texelFetch(depth_map, pixel, 0).r;
        light += z > 0.0 ? texelFetch(source, pixel, 0).rgb : vec3(0.0);
        depth += z > 0.0 ? vec2(z, 1.0) : vec2(0.0);
    }
    half_source = depth.y > 0.0 ? vec4(light / depth.y, 1.0) : vec4(0.0);
    half_depth_mm = depth.y > 0.0 ? depth.x / depth.y : 0.0;
}
