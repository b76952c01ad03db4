// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "screen_surface.glsl"

// The unblurred light as the blurred light and as the sum to begin with.
layout(binding = 0) uniform sampler2D source; // rgb, matte

layout(location = 0) out vec4 blurred;
layout(location = 1) out vec4 sum;

void main() {
    vec4 light = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
#if DEPTH_OUT
    light.a = texelFetch(shape_map, ivec2(gl_FragCoord.xy), 0).x;
#endif
    blurred = light;
    sum = light;
}
