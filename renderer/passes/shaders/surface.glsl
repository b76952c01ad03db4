// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// The point of the surface that a pixel shows, from surface.vert or unwrapped.vert. llvmpipe finds centroid values with
// the depth of the pixel's middle, which stretches them all alike; `unity` tells by how much, as its value is 1.
in Surface {
    centroid vec3 position_mm;
    centroid vec3 normal;
    centroid vec4 tangent;
    centroid vec2 uv;
    centroid float depth_mm;
    centroid float unity;
} interpolated;

vec3 surface_position_mm() { return interpolated.position_mm / interpolated.unity; }
vec3 surface_normal() { return interpolated.normal / interpolated.unity; }
vec4 surface_tangent() { return interpolated.tangent / interpolated.unity; }
vec2 surface_uv() { return interpolated.uv / interpolated.unity; }
float surface_depth_mm() { return interpolated.depth_mm / interpolated.unity; }

// A map where the surface shows it. Far repeats are left out: llvmpipe's anisotropic filter never ends beyond 2^24
// texels, where floats miss whole numbers. (With textureGrad it does not filter anisotropically at all.)
vec4 surface_texture(sampler2D map) {
    vec2 uv = surface_uv();
    return texture(map, mix(fract(uv), uv, lessThan(abs(uv), vec2(1000.0))));
}
