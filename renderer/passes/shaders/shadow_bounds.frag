// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Least and greatest depth of the shadow map along one axis, `reach` texels to both sides: one of two passes.
layout(binding = 0) uniform sampler2D source; // red: depth, or least depth; green: greatest depth
uniform ivec2 axis;
uniform int reach;
uniform bool first_pass;

layout(location = 0) out vec2 bounds;

void main() {
    ivec2 last = textureSize(source, 0) - 1;
    bounds = vec2(1.0, 0.0);
    for (int i = -reach; i <= reach; ++i) {
        vec2 depths = texelFetch(source, clamp(ivec2(gl_FragCoord.xy) + i * axis, ivec2(0), last), 0).rg;
        bounds = vec2(min(bounds.x, depths.x), max(bounds.y, first_pass ? depths.x : depths.y));
    }
}
