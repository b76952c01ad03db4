// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Scattered light, coloured by what is applied after scattering, plus what is reflected, times the coverage. The
// background, whose level may be another, is added at the end.
layout(binding = 0) uniform sampler2D scattered_map;
layout(binding = 1) uniform sampler2D after_map;
layout(binding = 2) uniform sampler2D specular_map; // alpha: coverage

layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 specular = texelFetch(specular_map, pixel, 0);
    vec3 skin = texelFetch(scattered_map, pixel, 0).rgb * texelFetch(after_map, pixel, 0).rgb + specular.rgb;
    color = vec4(skin * specular.a, specular.a);
}
