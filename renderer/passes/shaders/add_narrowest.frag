// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The profile on the screen, from its wider Gaussians in texture space and its narrowest one on the screen.
layout(binding = 0) uniform sampler2D narrowest_map;
layout(binding = 1) uniform sampler2D gathered_map;
uniform vec3 narrowest_weight;

layout(location = 0) out vec4 scattered;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 gathered = texelFetch(gathered_map, pixel, 0);
    scattered = vec4(narrowest_weight * texelFetch(narrowest_map, pixel, 0).rgb + gathered.rgb, gathered.a);
}
