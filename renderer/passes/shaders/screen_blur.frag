#version 450 core
#include "stretch.glsl"

// One 1D Gaussian over the skin on the screen. Taps beside the skin have matte 0 and take no part; the sum is
// divided by the matte it met, so that no background bleeds in.
layout(binding = 0) uniform sampler2D source; // rgb times matte, matte
uniform ivec2 axis;
uniform float sigma_mm;
uniform float taps[7]; // weights at -3 ... 3 standard deviations

layout(location = 0) out vec4 blurred;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_map, pixel, 0).r;
    if (depth <= 0.0) {
        blurred = vec4(0.0);
        return;
    }
    float step_px = min(sigma_mm * stretch_px_per_mm(pixel, axis, depth), widest_px);
    vec2 texel = 1.0 / vec2(textureSize(source, 0));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 7; ++i) {
        vec2 place = gl_FragCoord.xy + vec2(axis) * (float(i - 3) * step_px);
        sum += taps[i] * textureLod(source, place * texel, 0.0);
    }
    blurred = vec4(sum.rgb / sum.a, 1.0);
}
