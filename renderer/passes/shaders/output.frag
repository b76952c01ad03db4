// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Bloom, background, exposure, and the sRGB transfer function [IEC1999]. Row 0 becomes the image's top.
layout(binding = 0) uniform sampler2D color_map; // light of the skin times coverage, coverage
layout(binding = 1) uniform sampler2D bloom_map;
uniform float bloom_strength;
uniform vec3 skin_exposure; // with the level that the light was divided by
uniform vec3 background;    // exposed

layout(location = 0) out vec4 srgb;
layout(location = 1) out vec4 linear;

vec3 encoded(vec3 light) {
    vec3 x = clamp(light, 0.0, 1.0);
    return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

void main() {
    ivec2 size = textureSize(color_map, 0);
    ivec2 pixel = ivec2(gl_FragCoord.x, size.y - 1 - int(gl_FragCoord.y));
    vec4 color = texelFetch(color_map, pixel, 0);
    vec4 bloomed = color;
    if (bloom_strength > 0.0) { // else nothing was drawn into the map
        bloomed = mix(color, texture(bloom_map, (vec2(pixel) + 0.5) / vec2(size)), bloom_strength);
    }
    vec3 light = bloomed.rgb * skin_exposure + background * (1.0 - bloomed.a);
    srgb = vec4(encoded(light), 1.0);
    linear = vec4(light, color.a);
}
