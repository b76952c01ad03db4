// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// One 1D Gaussian over the charts [DEonLuebke2007]. Taps on another chart, or on none, take no part. Taps stand on whole
// texels, as in screen_blur.frag. A depth test keeps it to texels on charts.
// REACH (taps to each side), ALONG_V, CHART_IN, CHART_OUT and ADD (whether to add to the profile's sum, by blending) are
// defined by the program.
layout(binding = 0) uniform sampler2D source;      // rgb times mask; mask or, where CHART_IN is set, the chart
layout(binding = 1) uniform sampler2D stretch_map; // texels per unit of length along u and v
layout(binding = 2) uniform sampler2D chart_map;   // 0: no chart
layout(binding = 3) uniform sampler2D ratio_table; // optics::tap_ratio over the standard deviation in steps
uniform float sigma;           // of the stretch map's unit
uniform float widest_px;       // bound of a kernel's step
uniform float gather_variance; // texels squared: what reading the map between its texels will add
uniform float table_end;       // the greatest standard deviation of the table, steps

layout(location = 0) out vec4 blurred;
#if ADD
uniform vec3 weight_in_sum;
layout(location = 1) out vec4 added;
#endif

// The light of a texel times mask, and its mask on this chart. Beyond the map's edge there is no chart: its border is 0.
vec4 tap(vec2 place, float chart) {
    vec4 light = textureLod(source, place, 0.0);
#if CHART_IN
    return light.a == chart ? vec4(light.rgb, 1.0) : vec4(0.0);
#else
    return textureLod(chart_map, place, 0.0).r == chart ? light : vec4(0.0);
#endif
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float chart = texelFetch(chart_map, texel, 0).r;
    float wanted_px = sigma * texelFetch(stretch_map, texel, 0)[ALONG_V];
    float sigma_px = sqrt(max(wanted_px * wanted_px - gather_variance, 0.0));
    float step_px = clamp(ceil(sigma_px - 0.35), 1.0, floor(widest_px) + 1.0);
    int last_entry = textureSize(ratio_table, 0).x - 1;
    float place_in_table = min(sigma_px / (step_px * table_end), 1.0) * float(last_entry);
    int entry = int(place_in_table);
    float ratio = mix(texelFetch(ratio_table, ivec2(entry, 0), 0).r,
                      texelFetch(ratio_table, ivec2(min(entry + 1, last_entry), 0), 0).r, fract(place_in_table));

    vec4 sum = vec4(texelFetch(source, texel, 0).rgb, 1.0);
    vec2 size = vec2(textureSize(source, 0));
    float weight = 1.0; // ratio^(k^2)
    float next_ratio = ratio;
    for (int k = 1; k <= REACH; ++k) {
        weight *= next_ratio;
        next_ratio *= ratio * ratio;
        vec2 offset = vec2(1 - ALONG_V, ALONG_V) * (float(k) * step_px);
        sum += weight * tap((gl_FragCoord.xy + offset) / size, chart);
        sum += weight * tap((gl_FragCoord.xy - offset) / size, chart);
    }
    blurred = vec4(sum.rgb / sum.a, CHART_OUT == 1 ? chart : 1.0);
#if ADD
    added = vec4(weight_in_sum * blurred.rgb, 1.0);
#endif
}
