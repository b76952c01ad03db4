// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// A covered sample of the lit frame beside its diffuse light and depth: what is applied after scattering, in [0, 1], to
// 16 bits; what is reflected, as half floats; and a 1 that says it is covered.
uvec4 packed_sample(vec3 after_scattering, vec3 specular) {
    return uvec4(packUnorm2x16(after_scattering.rg), packUnorm2x16(vec2(after_scattering.b, 1.0)),
                 packHalf2x16(specular.rg), packHalf2x16(vec2(specular.b, 0.0)));
}

bool is_covered(uvec4 sample_) { return sample_.y != 0u; }
vec3 after_scattering_of(uvec4 sample_) { return vec3(unpackUnorm2x16(sample_.x), unpackUnorm2x16(sample_.y).x); }
vec3 specular_of(uvec4 sample_) { return vec3(unpackHalf2x16(sample_.z), unpackHalf2x16(sample_.w).x); }
