// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// How a round kernel on the surface looks on the screen.
layout(binding = 1) uniform sampler2D surface_map; // depth in millimetres, 0 where there is no skin; tilt along x, y

uniform float focal_px;
uniform vec2 middle_px;      // where the viewing axis meets the image
uniform float kernel_px_mm;  // pixels per millimetre of width at a depth of 1 mm: focal_px, or from alpha
uniform float beta_px;       // published: weight of the depth's gradient
uniform float widest_px;     // bound of a kernel's step, for depths near 0

// The point's place in view space over its depth.
vec3 ray(vec2 place_px) { return vec3((place_px - middle_px) / focal_px, 1.0); }

// A kernel's two passes: pixels per millimetre of the pass along x, of the pass along y, and how far the second leans,
// pixels of x per pixel of y.
//
// Steps along x and y on the screen are steps T_u, T_v on the surface, z / focal_px times those below. A Gaussian on
// the surface is exp(-(M_uu x^2 + 2 M_uv x y + M_vv y^2) / 2v) on the screen, M being their products. That is a
// Gaussian along x of variance v / M_uu, then one along (-M_uv / M_uu, 1) of variance v M_uu / det M: two 1D passes,
// exact for planes however tilted. With no tilt they are the published ones.
vec3 kernel_shape(vec3 surface, vec2 place_px) {
#if PUBLISHED_FORESHORTENING // [Jimenez2009, Eqs. 2-3]; the tilt times depth / focal_px is the gradient per pixel
    vec2 gradient = abs(surface.yz) * surface.x / focal_px;
    return vec3(kernel_px_mm / (surface.x + beta_px * gradient), 0.0);
#else
    vec3 q = ray(place_px);
    vec3 T_u = vec3(1.0, 0.0, 0.0) + surface.y * q;
    vec3 T_v = vec3(0.0, 1.0, 0.0) + surface.z * q;
    float uu = dot(T_u, T_u);
    float uv = dot(T_u, T_v);
    vec3 across = cross(T_u, T_v);
    float px_per_mm = kernel_px_mm / surface.x;
    return vec3(px_per_mm * inversesqrt(uu), px_per_mm * sqrt(uu / dot(across, across)), -uv / uu);
#endif
}
