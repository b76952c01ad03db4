// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The blur of a thin lens in one gather. Each tap counts as far as its own disk reaches this pixel, so that what is
// sharp spreads nowhere; what lies behind this pixel spreads no farther over it than the pixel itself is unsharp.
layout(binding = 0) uniform sampler2D color_map; // light times coverage, coverage
layout(binding = 1) uniform sampler2D depth_map; // millimetres, 0 where there is no skin
uniform float focus_mm;
uniform float scale_px;  // radius of what is at infinity
uniform float widest_px; // bound of all radii
uniform float near_px;   // radius of the nearest skin, 0 if it is not before the focus

layout(location = 0) out vec4 blurred;

const int taps = 24;
const int probes = 8;
const float golden_angle = 2.39996323;

/// Radius of the disk that a depth spreads over. What is not skin has no depth and is taken to be sharp, and far.
float radius_px(float depth) {
    return depth > 0.0 ? min(scale_px * abs(1.0 - focus_mm / depth), widest_px) : 0.0;
}

float depth_at(ivec2 pixel) {
    float depth = texelFetch(depth_map, clamp(pixel, ivec2(0), textureSize(depth_map, 0) - 1), 0).r;
    return depth > 0.0 ? depth : 1e30;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(color_map, 0) - 1;
    float own_depth = depth_at(pixel);
    float own_px = own_depth < 1e30 ? radius_px(own_depth) : 0.0;

    // Search as far as the pixel itself is spread, or as what is before it, or beside it, reaches.
    float search_px = own_px;
    for (int i = 0; i < probes; ++i) {
        float far_px = max(near_px, own_px > 0.0 ? 0.0 : widest_px) * ((i & 1) == 0 ? 0.5 : 1.0);
        float angle = 6.2831853 / float(probes) * float(i);
        float depth = depth_at(pixel + ivec2(round(far_px * vec2(cos(angle), sin(angle)))));
        if (depth < own_depth) {
            search_px = max(search_px, radius_px(depth));
        }
    }

    vec4 sum = texelFetch(color_map, pixel, 0) / max(own_px * own_px, 1.0);
    float total = 1.0 / max(own_px * own_px, 1.0);
    if (search_px > 0.5) {
        // Each tap stands for an equal share of the disk, the pixel itself for one more.
        float share = search_px * search_px / float(taps);
        sum /= max(share, 1.0);
        total /= max(share, 1.0);
        for (int i = 0; i < taps; ++i) {
            float far_px = search_px * sqrt((float(i) + 0.5) / float(taps));
            float angle = golden_angle * float(i);
            ivec2 tap = clamp(pixel + ivec2(round(far_px * vec2(cos(angle), sin(angle)))), ivec2(0), last);
            float depth = depth_at(tap);
            float tap_px = depth < 1e30 ? radius_px(depth) : own_px;
            tap_px = depth > own_depth ? min(tap_px, own_px) : tap_px;
            float weight = clamp(tap_px - far_px + 0.5, 0.0, 1.0) / max(tap_px * tap_px, 1.0);
            sum += weight * texelFetch(color_map, tap, 0);
            total += weight;
        }
    }
    blurred = sum / total;
}
