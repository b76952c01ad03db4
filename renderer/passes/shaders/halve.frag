// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Half the resolution: each pixel is the mean of four.
layout(binding = 0) uniform sampler2D source;

layout(location = 0) out vec4 halved;

void main() {
    ivec2 first = 2 * ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(source, 0) - 1;
    halved = 0.25 * (texelFetch(source, min(first, last), 0) + texelFetch(source, min(first + ivec2(1, 0), last), 0) +
                     texelFetch(source, min(first + ivec2(0, 1), last), 0) +
                     texelFetch(source, min(first + ivec2(1, 1), last), 0));
}
