// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// One 1D Gaussian over the charts [DEonLuebke2007]. Taps on another chart, or on none, take no part.
layout(binding = 0) uniform sampler2D source;      // rgb times mask, mask
layout(binding = 1) uniform sampler2D stretch_map; // texels per millimetre along u and v
layout(binding = 2) uniform sampler2D chart_map;   // 0: no chart
uniform ivec2 axis;
uniform float sigma_mm;
uniform float widest_px;
uniform float taps[7]; // weights at -3 ... 3 standard deviations

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float chart = texelFetch(chart_map, texel, 0).r;
    if (chart == 0.0) {
        blurred = vec4(0.0);
        return;
    }
    vec2 stretch = texelFetch(stretch_map, texel, 0).xy;
    float step_px = min(sigma_mm * dot(stretch, vec2(axis)), widest_px);
    ivec2 last = textureSize(chart_map, 0) - 1;
    vec2 size = vec2(textureSize(source, 0));
    vec4 sum = taps[3] * texelFetch(source, texel, 0);
    for (int i = 0; i < 7; ++i) {
        vec2 place = gl_FragCoord.xy + vec2(axis) * (float(i - 3) * step_px);
        ivec2 at = ivec2(floor(place));
        bool same = all(greaterThanEqual(at, ivec2(0))) && all(lessThanEqual(at, last)) &&
                    texelFetch(chart_map, at, 0).r == chart;
        if (i != 3 && same) {
            sum += taps[i] * textureLod(source, place / size, 0.0);
        }
    }
    blurred = vec4(sum.rgb / sum.a, 1.0);
}
