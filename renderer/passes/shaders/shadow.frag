// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#version 450 core

// The depth once more as a colour, for taking its bounds.
layout(location = 0) out float depth;

void main() { depth = gl_FragCoord.z; }
