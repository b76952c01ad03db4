// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "screen_surface.glsl"

// One 1D Gaussian over the skin on the screen, and its share of the profile's sum. Taps beside the skin have matte 0
// and take no part; the sum is divided by the matte it met, so that no background bleeds in.
// REACH (taps to each side), PUBLISHED_TAPS, REJECT_GAPS, SECOND_PASS, EARLY_TEST, DEPTH_IN and DEPTH_OUT are defined by
// the program: loops and branches that a compiler cannot see through cost as much as the taps.
layout(binding = 0) uniform sampler2D source;      // rgb times matte; matte or, where DEPTH_IN is set, depth
layout(binding = 3) uniform sampler2D ratio_table; // optics::tap_ratio over the standard deviation in steps
layout(binding = 4) uniform sampler2D carried;     // light that narrower Gaussians left as it was

uniform float sigma_mm;
uniform float published_weights[4]; // of the taps, from the middle outwards
uniform float table_end;            // the greatest standard deviation of the table, steps

layout(location = 0) out vec4 blurred;
#if SECOND_PASS
uniform vec3 share;         // weight of this Gaussian in the sum
uniform vec3 carried_share; // weight of the narrower ones
layout(location = 1) out vec4 sum_of_shares;
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(shape_map, pixel, 0);
#if !EARLY_TEST
    if (surface.x <= 0.0 || (before_mm > 0.0 && surface.x >= before_mm)) {
        discard;
    }
#endif
#if SECOND_PASS
    float sigma_px = sigma_mm * surface.z;
    vec2 axis = vec2(surface.w, 1.0);
#else
    float sigma_px = sigma_mm * surface.y;
    vec2 axis = vec2(1.0, 0.0);
#endif

#if PUBLISHED_TAPS
    axis *= min(sigma_px, widest_px);
#else
    // Taps stand on pixels, a whole number of pixels apart, and reach over three standard deviations; the k-th weighs
    // ratio^(k^2), and the ratio is the one that gives them the Gaussian's variance.
    float step_px = clamp(ceil(3.0 / float(max(REACH, 3)) * sigma_px - 0.35), 1.0, floor(widest_px) + 1.0);
    axis *= step_px;
    // A step of a whole pixel may be longer than the kernel; however steep the lean, no step is wider than a kernel that
    // faces the camera.
    float facing_px = sigma_mm * kernel_px_mm / surface.x;
    axis.x = clamp(axis.x, -1.5 * facing_px - 1.0, 1.5 * facing_px + 1.0);
    float size_of_table = float(textureSize(ratio_table, 0).x);
    float place_in_table = min(sigma_px / (step_px * table_end), 1.0) * (size_of_table - 1.0) + 0.5;
    float ratio = textureLod(ratio_table, vec2(place_in_table / size_of_table, 0.5), 0.0).r;
    float next_ratio = ratio; // ratio^(2k - 1)
    float weight_of_pair = 1.0;
#endif

#if REJECT_GAPS
    // A tap that lies off the surface's plane is farther away than it looks. On the plane, 1 / depth is linear.
    vec3 plane = texelFetch(plane_map, pixel, 0).xyz;
    float inverse_depth = 1.0 / surface.x;
    float off_plane_scale = -0.72134752 / max(sigma_mm * sigma_mm, 1e-30); // log2(e) / 2
#endif
    ivec2 size = textureSize(source, 0);
    vec4 sum = vec4(texelFetch(source, pixel, 0).rgb, 1.0);
#if PUBLISHED_TAPS
    sum *= published_weights[0];
#endif
    for (int i = 0; i < 2 * REACH; ++i) {
        int k = (i >> 1) + 1;
        vec2 place = gl_FragCoord.xy + float((i & 1) == 0 ? k : -k) * axis;
        ivec2 tap = ivec2(floor(place));
        // Kernels that reach over the image's edge see its mirror image.
        ivec2 inner = clamp(min(max(tap, -1 - tap), 2 * size - 1 - tap), ivec2(0), size - 1);
#if PUBLISHED_TAPS
        float weight = published_weights[k];
        vec4 light = textureLod(source, place / vec2(size), 0.0);
#else
        if ((i & 1) == 0) {
            weight_of_pair *= next_ratio;
            next_ratio *= ratio * ratio;
        }
        float weight = weight_of_pair;
        vec4 light = texelFetch(source, inner, 0);
#endif
#if DEPTH_IN
        float depth = light.a;
        light.a = depth > 0.0 ? 1.0 : 0.0;
#elif REJECT_GAPS
        float depth = texelFetch(depth_map, inner, 0).r;
#endif
#if REJECT_GAPS
        float off_plane_mm = plane.z * (depth * (inverse_depth - dot(plane.xy, vec2(tap - pixel))) - 1.0);
        float on_plane = exp2(off_plane_scale * off_plane_mm * off_plane_mm);
        weight *= inner == tap ? on_plane : 1.0; // a mirror image is of another place
#endif
        sum += weight * light;
    }
    blurred = vec4(sum.rgb / sum.a, DEPTH_OUT == 1 ? surface.x : 1.0);
#if SECOND_PASS
    vec3 added = share * blurred.rgb;
    if (carried_share != vec3(0.0)) {
        added += carried_share * texelFetch(carried, pixel, 0).rgb;
    }
    sum_of_shares = vec4(added, 1.0);
#endif
}
