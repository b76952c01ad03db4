// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace support {

/// Where the letters are: one coverage value a pixel, 0 to 255, rows from the top down.
struct TextRaster {
    int width = 0, height = 0;
    int baseline = 0; ///< the row that letters stand on
    std::vector<std::uint8_t> coverage;
};

/// Draw one line of UTF-8 text, `size_px` pixels per em, in DejaVu Sans. All lines of a size are equally
/// high. Bytes that are not UTF-8 and letters that the font lacks show as its box. Throws Failure without the
/// font.
TextRaster text_raster(std::string_view text, int size_px);

/// The width that text_raster() would give, without drawing.
int text_width(std::string_view text, int size_px);

} // namespace support
