// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "packed_sample.glsl"

// Resolve the lit frame: what scatters and its depth are means over the samples that show skin, the matte is 1 where any
// does; the rest are means over all covered samples, and the coverage is their share. Nothing of the background mixes
// into the skin.
layout(binding = 0) uniform sampler2DMS diffuse_samples; // rgb, depth
layout(binding = 1) uniform usampler2DMS rest_samples;
uniform int samples;

layout(location = 0) out vec4 diffuse;          // rgb, matte
layout(location = 1) out vec4 after_scattering; // rgb, 1
layout(location = 2) out vec4 specular;         // rgb, coverage
layout(location = 3) out float depth_mm;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 d = vec3(0.0);
    vec3 a = vec3(0.0);
    vec3 s = vec3(0.0);
    float z = 0.0;
    float skin = 0.0;
    float covered = 0.0;
    for (int i = 0; i < samples; ++i) {
        uvec4 rest = texelFetch(rest_samples, pixel, i);
        if (is_covered(rest)) {
            vec4 light = texelFetch(diffuse_samples, pixel, i);
            covered += 1.0;
            skin += light.a > 0.0 ? 1.0 : 0.0;
            d += light.rgb;
            a += after_scattering_of(rest);
            s += specular_of(rest);
            z += light.a;
        }
    }
    float scale = covered > 0.0 ? 1.0 / covered : 0.0;
    float skin_scale = skin > 0.0 ? 1.0 / skin : 0.0;
    diffuse = vec4(d * skin_scale, skin > 0.0 ? 1.0 : 0.0);
    after_scattering = vec4(a * scale, 1.0);
    specular = vec4(s * scale, covered / float(samples));
    depth_mm = z * skin_scale;
}
