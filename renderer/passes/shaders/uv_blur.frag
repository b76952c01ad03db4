// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// One 1D Gaussian over the charts [DEonLuebke2007]. Taps on another chart, or on none, take no part. Taps stand on whole
// texels, as in screen_blur.frag.
layout(binding = 0) uniform sampler2D source;      // rgb times mask, mask
layout(binding = 1) uniform sampler2D stretch_map; // texels per unit of length along u and v
layout(binding = 2) uniform sampler2D chart_map;   // 0: no chart
layout(binding = 3) uniform sampler2D ratio_table; // optics::tap_ratio over the standard deviation in steps
uniform ivec2 axis;
uniform float sigma;           // of the stretch map's unit
uniform float widest_px;       // bound of a kernel's step
uniform float gather_variance; // texels squared: what reading the map between its texels will add
uniform float table_end;       // the greatest standard deviation of the table, steps

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float chart = texelFetch(chart_map, texel, 0).r;
    if (chart == 0.0) {
        blurred = vec4(0.0);
        return;
    }
    float wanted_px = sigma * dot(texelFetch(stretch_map, texel, 0).xy, vec2(axis));
    float sigma_px = sqrt(max(wanted_px * wanted_px - gather_variance, 0.0));
    float step_px = clamp(ceil(sigma_px - 0.35), 1.0, floor(widest_px) + 1.0);
    float size_of_table = float(textureSize(ratio_table, 0).x);
    float place_in_table = min(sigma_px / (step_px * table_end), 1.0) * (size_of_table - 1.0) + 0.5;
    float ratio = textureLod(ratio_table, vec2(place_in_table / size_of_table, 0.5), 0.0).r;

    vec4 sum = texelFetch(source, texel, 0);
    vec2 size = vec2(textureSize(source, 0));
    float weight = 1.0; // ratio^(k^2)
    float next_ratio = ratio;
    for (int k = 1; k <= 3; ++k) {
        weight *= next_ratio;
        next_ratio *= ratio * ratio;
        vec2 offset = vec2(axis) * (float(k) * step_px);
        vec2 after = (gl_FragCoord.xy + offset) / size;
        vec2 before = (gl_FragCoord.xy - offset) / size;
        // Beyond the map's edge there is no chart: its border is 0.
        sum += (textureLod(chart_map, after, 0.0).r == chart ? weight : 0.0) * textureLod(source, after, 0.0);
        sum += (textureLod(chart_map, before, 0.0).r == chart ? weight : 0.0) * textureLod(source, before, 0.0);
    }
    blurred = vec4(sum.rgb / sum.a, 1.0);
}
