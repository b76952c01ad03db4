// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// One 1D Gaussian over the charts [DEonLuebke2007]. Taps on another chart, or on none, take no part. Taps stand on whole
// texels, as in screen_blur.frag. A depth test keeps it to texels on charts.
// REACH (taps to each side), ALONG_V, CHART_IN and CHART_OUT are defined by the program.
layout(binding = 0) uniform sampler2D source;      // rgb times mask; mask or, where CHART_IN is set, the chart
layout(binding = 1) uniform sampler2D stretch_map; // texels per unit of length along u and v
layout(binding = 2) uniform sampler2D chart_map;   // 0: no chart
layout(binding = 3) uniform sampler2D ratio_table; // optics::tap_ratio over the standard deviation in steps
uniform float sigma;           // of the stretch map's unit
uniform float widest_px;       // bound of a kernel's step
uniform float gather_variance; // texels squared: what reading the map between its texels will add
uniform float table_end;       // the greatest standard deviation of the table, steps

layout(location = 0) out vec4 blurred;

const ivec2 axis = ivec2(1 - ALONG_V, ALONG_V);

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
    ivec2 last_texel = textureSize(source, 0) - 1;
    int step_texels = int(step_px);
    float pair_weight = 1.0; // ratio^(k^2)
    float next_ratio = ratio;
    for (int i = 0; i < 2 * REACH; ++i) {
        int k = (i >> 1) + 1;
        if ((i & 1) == 0) {
            pair_weight *= next_ratio;
            next_ratio *= ratio * ratio;
        }
        // Beyond the map's edge there is no chart.
        ivec2 tap = texel + axis * ((i & 1) == 0 ? k * step_texels : -k * step_texels);
        ivec2 inside = clamp(tap, ivec2(0), last_texel);
        vec4 light = texelFetch(source, inside, 0);
#if CHART_IN
        float its_chart = light.a;
        light.a = 1.0;
#else
        float its_chart = texelFetch(chart_map, inside, 0).r;
#endif
        sum += (its_chart == chart && inside == tap ? pair_weight : 0.0) * light;
    }
    blurred = vec4(sum.rgb / sum.a, CHART_OUT == 1 ? chart : 1.0);
}
