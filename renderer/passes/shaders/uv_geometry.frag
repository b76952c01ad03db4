// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "surface.glsl"

// Texels per unit of length along u and v (the stretch map of [DEonLuebke2007]) and the chart.
uniform float chart;
uniform float unit_mm; // makes the numbers fit half floats

const float greatest_stretch = 1e4; // for triangles that have an area in the map alone

layout(location = 0) out vec4 stretch; // u, v, unused, 1
layout(location = 1) out float chart_id;
layout(location = 2) out float layers; // added up: how many triangles cover a texel

void main() {
    vec3 along_u = dFdx(surface_position_mm());
    vec3 along_v = dFdy(surface_position_mm());
    vec2 unit_per_texel = vec2(length(along_u), length(along_v)) / unit_mm;
    stretch = vec4(1.0 / max(unit_per_texel, vec2(1.0 / greatest_stretch)), 0.0, 1.0);
    chart_id = chart;
    layers = 1.0;
}
