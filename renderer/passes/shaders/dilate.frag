// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Give the texels around each chart the value of the chart's nearest texel.
layout(binding = 0) uniform sampler2D source;
layout(binding = 1) uniform isampler2D nearest_map; // texel of the nearest chart point, or -1

layout(location = 0) out vec4 dilated;

void main() {
    ivec2 nearest = texelFetch(nearest_map, ivec2(gl_FragCoord.xy), 0).xy;
    dilated = nearest.x >= 0 ? vec4(texelFetch(source, nearest, 0).rgb, 1.0) : vec4(0.0);
}
