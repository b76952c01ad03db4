// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// How wide a kernel is at each pixel of the lit frame [Jimenez2009, Eqs. 2-3]: pixels per millimetre of width along
// x and y; 0 where there is no skin.
layout(binding = 0) uniform sampler2D depth_map; // millimetres, 0 where there is no skin

uniform float kernel_px_mm; // pixels per millimetre of width at a depth of 1 mm: the physical value of alpha
uniform float beta_px;      // weight of the depth gradient; physically equal to kernel_px_mm

layout(location = 0) out vec2 px_per_mm;

float depth_at(ivec2 pixel) {
    ivec2 last = textureSize(depth_map, 0) - 1;
    return texelFetch(depth_map, clamp(pixel, ivec2(0), last), 0).r;
}

// |d depth / d pixel| along an axis: the smaller of both one-sided differences that stay on skin, so that neither
// the silhouette nor the edge of a nearer part narrows the kernels of pixels that lie beside it.
float depth_gradient(ivec2 pixel, ivec2 axis, float depth) {
    float before = depth_at(pixel - axis);
    float after = depth_at(pixel + axis);
    float left = before > 0.0 ? abs(depth - before) : 1e30;
    float right = after > 0.0 ? abs(after - depth) : 1e30;
    float gradient = min(left, right);
    return gradient < 1e30 ? gradient : 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depth_at(pixel);
    vec2 gradient = vec2(depth_gradient(pixel, ivec2(1, 0), depth), depth_gradient(pixel, ivec2(0, 1), depth));
    px_per_mm = depth > 0.0 ? max(kernel_px_mm / (depth + beta_px * gradient), vec2(1e-9)) : vec2(0.0);
}
