// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// As resolve.frag for a frame of one sample a pixel.
layout(binding = 0) uniform sampler2D diffuse_samples;
layout(binding = 1) uniform sampler2D after_samples;
layout(binding = 2) uniform sampler2D specular_samples;
layout(binding = 3) uniform sampler2D depth_samples;

layout(location = 0) out vec4 diffuse;
layout(location = 1) out vec4 after_scattering;
layout(location = 2) out vec4 specular;
layout(location = 3) out float depth_mm;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    diffuse = texelFetch(diffuse_samples, pixel, 0);
    after_scattering = texelFetch(after_samples, pixel, 0);
    specular = texelFetch(specular_samples, pixel, 0);
    depth_mm = texelFetch(depth_samples, pixel, 0).r;
}
