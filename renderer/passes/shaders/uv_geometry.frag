// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "material.glsl"

// Texels per millimetre along u and v (the stretch map of [DEonLuebke2007]) and the chart.
uniform float chart;

layout(location = 0) out vec4 stretch; // u, v, unused, 1
layout(location = 1) out float chart_id;
layout(location = 2) out float layers; // added up: how many triangles cover a texel

void main() {
    vec3 along_u = dFdx(surface.position_mm);
    vec3 along_v = dFdy(surface.position_mm);
    stretch = vec4(1.0 / max(length(along_u), 1e-6), 1.0 / max(length(along_v), 1e-6), 0.0, 1.0);
    chart_id = chart;
    layers = 1.0;
}
