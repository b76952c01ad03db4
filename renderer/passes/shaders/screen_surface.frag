// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The surface at each pixel of the lit frame: its depth (millimetres, 0 where there is no skin) and how it is tilted,
// as the depth's gradient per unit of width, d depth / d x and d depth / d y.
layout(binding = 0) uniform sampler2D depth_map;

uniform float focal_px;

layout(location = 0) out vec4 depth_and_tilt;

float depth_at(ivec2 pixel) {
    ivec2 last = textureSize(depth_map, 0) - 1;
    return texelFetch(depth_map, clamp(pixel, ivec2(0), last), 0).r;
}

// The gradient along an axis: the smaller of both one-sided differences that stay on skin, so that neither the
// silhouette nor the edge of a nearer part tilts the pixels that lie beside it. Differences of 1 / depth are exact for
// planes in perspective; d (1 / z) = -dz / z^2, and a pixel is z / focal_px wide.
float tilt(ivec2 pixel, ivec2 axis, float depth) {
    float before = depth_at(pixel - axis);
    float after = depth_at(pixel + axis);
    float left = before > 0.0 ? depth / before - 1.0 : 1e30;
    float right = after > 0.0 ? 1.0 - depth / after : 1e30;
    float difference = abs(left) < abs(right) ? left : right;
    return abs(difference) < 1e30 ? focal_px * difference : 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depth_at(pixel);
    depth_and_tilt = vec4(0.0);
    if (depth > 0.0) {
        depth_and_tilt = vec4(depth, tilt(pixel, ivec2(1, 0), depth), tilt(pixel, ivec2(0, 1), depth), 0.0);
    }
}
