// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Half the resolution: each pixel is the mean of four, or of what it covers where the size is odd.
layout(binding = 0) uniform sampler2D source;

layout(location = 0) out vec4 halved;

void main() {
    vec2 half_size = vec2((textureSize(source, 0) + 1) / 2);
    halved = texture(source, gl_FragCoord.xy / half_size);
}
