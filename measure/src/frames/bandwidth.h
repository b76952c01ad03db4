// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <string>

namespace measure {

/// Bytes a texel that a method blurs into takes: RGBA of 32 bits a channel on a CPU, of 16 on a GPU, unless
/// the method names another number of bits.
int blur_texel_bytes(int target_bits, bool on_cpu);

/// Bytes that the node ss_full moves where it accumulates on the fly: each texel that a pass reads, once, and
/// each that it writes, over the skin's pixels. `counts` are the frame's.
double blur_bytes(const std::map<std::string, long long>& counts, long long skin_pixels, int texel_bytes);

/// Bytes a millisecond, read and written, of a copy from one texture of that format and size to another.
double copy_bytes_per_ms(int texel_bytes, int width, int height);

} // namespace measure
