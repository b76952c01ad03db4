// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "material.glsl"

// Light that enters the skin, in texture space [DEonLuebke2007].
layout(location = 0) out vec4 irradiance;

void main() {
    vec3 N = mapped_normal();
    vec3 sum = entering_ambient(N);
#if BEAMS > 0
    float m = slope();
    float strength = specular_strength();
    for (int k = 0; k < BEAMS; ++k) {
        sum += entering_beam(k, N, m, strength, visibility(k));
    }
#endif
    irradiance = vec4(entering_radiance(sum, albedo()), 1.0);
}
