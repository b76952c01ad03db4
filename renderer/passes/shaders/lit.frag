// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "material.glsl"

// The lit frame in one pass [Jimenez2009, section 4]: what scatters, what is applied after scattering, what is
// reflected, and how deep it lies. Alpha of the diffuse light is the matte, of the specular the coverage.
// Where a pixel has several samples (PACKED, defined by the program), each is stored in 32 bytes, as writing them costs
// as much as computing them: see packed_sample.glsl.
#if PACKED
#include "packed_sample.glsl"
layout(location = 0) out vec4 packed_diffuse;
layout(location = 1) out uvec4 packed_rest;
vec4 diffuse, after_scattering, specular;
float depth_mm;
#else
layout(location = 0) out vec4 diffuse;
layout(location = 1) out vec4 after_scattering;
layout(location = 2) out vec4 specular;
layout(location = 3) out float depth_mm;
#endif

uniform vec3 eye_mm;
uniform float fresnel_f0;

// Highlights beyond this multiple of a white surface end here; half floats end at 65504.
const float brightest = 16384.0;

// Kelemen/Szirmay-Kalos [DEonLuebke2007]; h is not normalised, Beckmann's lobe is computed, not
// looked up, and the factor 1 / pi is in the caller.
float kelemen_szirmay_kalos(vec3 N, vec3 L, vec3 V, float m) {
    vec3 h = L + V;
    float hh = dot(h, h);
    vec3 H = h * inversesqrt(max(hh, 1e-8));
    float NoH = max(dot(N, H), 1e-3);
    float c2 = NoH * NoH;
    float beckmann = exp(-(1.0 - c2) / (c2 * m * m)) / (m * m * c2 * c2);
    float fresnel = fresnel_f0 + (1.0 - fresnel_f0) * pow(clamp(1.0 - dot(V, H), 0.0, 1.0), 5.0);
    return max(dot(N, L), 0.0) * beckmann * fresnel / max(hh, 1e-8);
}

void main() {
    vec3 N = mapped_normal();
    vec3 V = direction_of(eye_mm - surface_position_mm());
    float m = slope();
    float strength = specular_strength();
    vec3 color = albedo();
    vec3 entering = entering_ambient(N);
    vec3 reflected = vec3(0.0);
#if BEAMS > 0
    for (int k = 0; k < BEAMS; ++k) {
        float visible = visibility(k);
        entering += entering_beam(k, N, m, strength, visible);
#if SPECULAR
        float lobe = strength * kelemen_szirmay_kalos(N, light_direction[k], V, m);
        reflected += light_irradiance[k] * (visible * lobe / pi);
#endif
    }
#endif
    diffuse = vec4(entering_radiance(entering, color), 1.0);
    vec3 leaving = part_of_color(color, 1.0 - texture_mix);
    leaving *= 1.0 - strength * specular_albedo(dot(N, V), m);
    specular = vec4(min(reflected, vec3(brightest)), 1.0);
    after_scattering = vec4(leaving, 1.0);
    depth_mm = surface_depth_mm();
#if !SCATTERS
    // What is not skin is lit at once, and leaves no skin here: neither light to blur, nor matte, nor depth.
    specular.rgb += diffuse.rgb * leaving;
    diffuse = vec4(0.0);
    after_scattering = vec4(0.0);
    depth_mm = 0.0;
#endif
#if PACKED
    packed_diffuse = vec4(diffuse.rgb, depth_mm);
    packed_rest = packed_sample(after_scattering.rgb, specular.rgb);
#endif
}
