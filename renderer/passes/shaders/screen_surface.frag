// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The surface at each pixel of the lit frame: its depth, its plane, and how a round kernel on it looks on the screen.
// PUBLISHED_FORESHORTENING is defined by the program.
layout(binding = 0) uniform sampler2D depth_map; // millimetres, 0 where there is no skin

uniform float focal_px;
uniform vec2 middle_px;     // where the viewing axis meets the image
uniform float kernel_px_mm; // pixels per millimetre of width at a depth of 1 mm: focal_px, or from alpha
uniform float beta_px;      // published: weight of the depth's gradient
uniform float nearest_mm;   // no skin before this depth

layout(location = 0) out vec4 shape; // depth, kernel_shape()
layout(location = 1) out vec4 plane; // see screen_surface.glsl

float depth_at(ivec2 pixel) {
    ivec2 last = textureSize(depth_map, 0) - 1;
    return texelFetch(depth_map, clamp(pixel, ivec2(0), last), 0).r;
}

// The tilt along an axis, the depth's gradient per unit of width: the smaller of both one-sided differences that stay on
// skin, so that neither the silhouette nor the edge of a nearer part tilts the pixels that lie beside it. Differences of
// 1 / depth are exact for planes in perspective; d (1 / z) = -dz / z^2, and a pixel is z / focal_px wide.
float tilt(ivec2 pixel, ivec2 axis, float depth) {
    float before = depth_at(pixel - axis);
    float after = depth_at(pixel + axis);
    float left = before > 0.0 ? depth / before - 1.0 : 1e30;
    float right = after > 0.0 ? 1.0 - depth / after : 1e30;
    float difference = abs(left) < abs(right) ? left : right;
    return abs(difference) < 1e30 ? focal_px * difference : 0.0;
}

// A kernel's two passes: pixels per millimetre of the pass along x, of the pass along y, and how far the second leans,
// pixels of x per pixel of y.
//
// Steps along x and y on the screen are steps T_u, T_v on the surface, z / focal_px times those below. A Gaussian on
// the surface is exp(-(M_uu x^2 + 2 M_uv x y + M_vv y^2) / 2v) on the screen, M being their products. That is a
// Gaussian along x of variance v / M_uu, then one along (-M_uv / M_uu, 1) of variance v M_uu / det M: two 1D passes,
// exact for planes however tilted. With no tilt they are the published ones.
vec3 kernel_shape(float depth, vec2 tilts, vec3 T_u, vec3 T_v, vec3 across) {
#if PUBLISHED_FORESHORTENING // [Jimenez2009, Eqs. 2-3]; the tilt times depth / focal_px is the gradient per pixel
    vec2 gradient = abs(tilts) * depth / focal_px;
    return vec3(kernel_px_mm / (depth + beta_px * gradient), 0.0);
#else
    float uu = dot(T_u, T_u);
    float px_per_mm = kernel_px_mm / depth;
    return vec3(px_per_mm * inversesqrt(uu), px_per_mm * sqrt(uu / dot(across, across)), -dot(T_u, T_v) / uu);
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = depth_at(pixel);
    shape = vec4(0.0);
    plane = vec4(0.0);
    gl_FragDepth = 0.0;
    if (depth > 0.0) {
        vec2 tilts = vec2(tilt(pixel, ivec2(1, 0), depth), tilt(pixel, ivec2(0, 1), depth));
        vec3 ray = vec3((gl_FragCoord.xy - middle_px) / focal_px, 1.0);
        vec3 T_u = vec3(1.0, 0.0, 0.0) + tilts.x * ray;
        vec3 T_v = vec3(0.0, 1.0, 0.0) + tilts.y * ray;
        vec3 across = cross(T_u, T_v); // its product with the ray is 1
        shape = vec4(depth, kernel_shape(depth, tilts, T_u, T_v, across));
        plane = vec4(tilts / (focal_px * depth), depth * inversesqrt(dot(across, across)), 0.0);
        gl_FragDepth = min(nearest_mm / depth, 1.0);
    }
}
