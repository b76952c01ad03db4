// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The bounds of a block and its eight neighbours.
layout(binding = 0) uniform sampler2D blocks; // least and greatest depth

layout(location = 0) out vec2 bounds;

void main() {
    ivec2 last = textureSize(blocks, 0) - 1;
    bounds = vec2(1.0, 0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 place = ivec2(gl_FragCoord.xy) + ivec2(i % 3, i / 3) - 1;
        vec2 b = texelFetch(blocks, clamp(place, ivec2(0), last), 0).rg;
        bounds = vec2(min(bounds.x, b.x), max(bounds.y, b.y));
    }
}
