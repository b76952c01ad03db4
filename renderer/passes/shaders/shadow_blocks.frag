// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Least and greatest depth of each block of the shadow map.
layout(binding = 0) uniform sampler2DArray shadow_maps;
uniform int layer;
uniform int block; // texels a side, even

layout(location = 0) out vec2 bounds;

void main() {
    vec2 size = vec2(textureSize(shadow_maps, 0).xy);
    vec2 first = floor(gl_FragCoord.xy) * float(block);
    vec4 least = vec4(1.0);
    vec4 greatest = vec4(0.0);
    for (int y = 0; y < block; y += 2) {
        for (int x = 0; x < block; x += 2) {
            vec4 depth = textureGather(shadow_maps, vec3((first + vec2(x, y) + 1.0) / size, layer));
            least = min(least, depth);
            greatest = max(greatest, depth);
        }
    }
    bounds = vec2(min(min(least.x, least.y), min(least.z, least.w)),
                  max(max(greatest.x, greatest.y), max(greatest.z, greatest.w)));
}
