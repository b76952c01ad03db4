// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// Bring the blurred irradiance maps from texture space to the screen: the weighted sum of the Gaussians.
in Surface {
    centroid vec3 position_mm;
    centroid vec3 normal;
    centroid vec4 tangent;
    centroid vec2 uv;
    centroid float depth_mm;
} surface;

layout(binding = 0) uniform sampler2D gaussian_maps[6]; // profiles have at most six Gaussians
uniform vec3 weights[6];
uniform int count;
uniform vec2 uv_origin;
uniform vec2 uv_scale;

layout(location = 0) out vec4 scattered;

void main() {
    vec2 place = (surface.uv - uv_origin) * uv_scale;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        vec4 g = texture(gaussian_maps[i], place);
        sum += weights[i] * g.rgb / max(g.a, 1e-3);
    }
    scattered = vec4(sum, 1.0);
}
