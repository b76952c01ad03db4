// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core
#include "material.glsl"

// Light that enters the skin, in texture space [DEonLuebke2007].
layout(location = 0) out vec4 irradiance;

void main() { irradiance = vec4(entering_light(mapped_normal(), albedo(), slope(), visibility()), 1.0); }
