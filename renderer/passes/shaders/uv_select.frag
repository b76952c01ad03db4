// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Which texels of a map to work on, as a depth buffer: those that stand for one in a wanted block.
layout(binding = 0) uniform isampler2D nearest_map; // texel of the nearest chart point, or -1
layout(binding = 1) uniform sampler2D block_map;    // 1: wanted

void main() {
    ivec2 nearest = texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).xy;
    ivec2 block = nearest * textureSize(block_map, 0) / textureSize(nearest_map, 0);
    bool wanted = nearest.x >= 0 && texelFetch(block_map, max(block, ivec2(0)), 0).r > 0.0;
    gl_FragDepth = wanted ? 1.0 : 0.0;
}
