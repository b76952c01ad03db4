// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace support {

/// Where the letters are: one coverage value a pixel, 0 to 255, rows from the top down.
struct TextRaster {
    int width = 0, height = 0;
    int baseline = 0; ///< the row that letters stand on
    std::vector<std::uint8_t> coverage;
};

/// The fonts that text is drawn in: DejaVu Sans, then, where it is installed, one for the letters that it
/// lacks, such as those of Chinese, Japanese and Korean. Throws Failure without the first.
std::vector<std::string> font_files();

/// The letters of a UTF-8 text, by their Unicode numbers; U+FFFD for each byte that is not UTF-8.
std::u32string code_points(std::string_view text);

/// The first letter of a UTF-8 text that none of the fonts has, as text; empty where there is none. Line
/// breaks are no letters.
std::string letter_without_font(std::string_view text);

/// Draw one line of UTF-8 text, `size_px` pixels per em. All lines of a size are equally
/// high. Bytes that are not UTF-8 and letters that the fonts lack show as a box. Throws Failure without the
/// font.
TextRaster text_raster(std::string_view text, int size_px);

/// The width that text_raster() would give, without drawing.
int text_width(std::string_view text, int size_px);

} // namespace support
