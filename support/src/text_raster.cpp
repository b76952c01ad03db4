// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/text_raster.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <support/error.h>

namespace support {
namespace {

constexpr std::array<const char*, 2> fonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                           "/usr/share/fonts/TTF/DejaVuSans.ttf"};

constexpr char32_t replacement = 0xfffd;

/// The code point at the text's front, which is taken off it.
char32_t take_code_point(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 0;
    bool whole = length > 0 && length <= text.size();
    char32_t code = length == 1 ? lead : lead & (0xffu >> (length + 1));
    for (std::size_t i = 1; whole && i < length; ++i) {
        whole = (byte(i) & 0xc0) == 0x80;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    text.remove_prefix(whole ? length : 1);
    return whole ? code : replacement;
}

/// FreeType's library and one face.
class Face {
public:
    explicit Face(int size_px) {
        const auto font = std::find_if(fonts.begin(), fonts.end(),
                                       [](const char* file) { return std::filesystem::exists(file); });
        if (font == fonts.end()) {
            throw failure("the font {} is needed to draw text; found none (Debian package fonts-dejavu-core)",
                          fonts[0]);
        }
        const bool ok = FT_Init_FreeType(&library_) == 0 && FT_New_Face(library_, *font, 0, &face_) == 0 &&
                        FT_Set_Pixel_Sizes(face_, 0, static_cast<FT_UInt>(size_px)) == 0;
        if (!ok) {
            throw failure("{}: cannot be used at {} pixels", *font, size_px);
        }
    }
    ~Face() {
        if (face_) {
            FT_Done_Face(face_);
        }
        FT_Done_FreeType(library_);
    }
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;
    FT_Face operator->() const { return face_; }
    FT_Face get() const { return face_; }

private:
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

void add_glyph(TextRaster& raster, const FT_GlyphSlot glyph, int pen_x, int baseline) {
    for (int row = 0; row < static_cast<int>(glyph->bitmap.rows); ++row) {
        for (int column = 0; column < static_cast<int>(glyph->bitmap.width); ++column) {
            const int x = pen_x + glyph->bitmap_left + column;
            const int y = baseline - glyph->bitmap_top + row;
            if (x >= 0 && x < raster.width && y >= 0 && y < raster.height) {
                auto& pixel =
                    raster.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) +
                                    static_cast<std::size_t>(x)];
                pixel = std::max(pixel, glyph->bitmap.buffer[row * glyph->bitmap.pitch + column]);
            }
        }
    }
}

} // namespace

TextRaster text_raster(std::string_view text, int size_px) {
    const Face face(size_px);
    constexpr int unit = 64; // FreeType counts in 64ths of a pixel
    const auto ascender = static_cast<int>(face->size->metrics.ascender / unit);
    const auto height = static_cast<int>(face->size->metrics.height / unit);

    // Measure, then draw.
    TextRaster raster;
    raster.height = height;
    for (const bool drawing : {false, true}) {
        int pen_x = 0;
        for (std::string_view rest = text; !rest.empty();) {
            const char32_t code = take_code_point(rest);
            if (FT_Load_Char(face.get(), code, FT_LOAD_RENDER) != 0) {
                throw failure("the letter U+{:04X} cannot be drawn", static_cast<std::uint32_t>(code));
            }
            if (drawing) {
                add_glyph(raster, face->glyph, pen_x, ascender);
            }
            pen_x += static_cast<int>(face->glyph->advance.x / unit);
        }
        if (!drawing) {
            raster.width = std::max(pen_x, 1);
            raster.coverage.assign(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(height),
                                   0);
        }
    }
    return raster;
}

} // namespace support
