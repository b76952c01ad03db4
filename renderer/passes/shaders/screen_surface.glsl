// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

// The surface at each pixel, from screen_surface.frag.
layout(binding = 1) uniform sampler2D shape_map; // depth in millimetres, 0 where there is no skin; kernel_shape()
layout(binding = 2) uniform sampler2D plane_map; // how the plane's 1 / depth falls per pixel along x and y; its distance
layout(binding = 5) uniform sampler2D depth_map;

uniform float kernel_px_mm; // pixels per millimetre of width at a depth of 1 mm
uniform float widest_px;    // bound of a kernel's step, for depths near 0
uniform float before_mm;    // only skin before this depth is drawn; 0: all
