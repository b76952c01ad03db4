// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <support/text_raster.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <utility>

#include <ft2build.h>
#include FT_FREETYPE_H

#include <support/error.h>

namespace support {
namespace {

constexpr std::array<const char*, 2> fonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                           "/usr/share/fonts/TTF/DejaVuSans.ttf"};
constexpr std::array<const char*, 2> further_fonts{
    "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
    "/usr/share/fonts/droid/DroidSansFallbackFull.ttf"};

/// The first of the files that is there; empty where none is.
std::string first_there(const std::array<const char*, 2>& files) {
    const auto file = std::find_if(files.begin(), files.end(),
                                   [](const char* name) { return std::filesystem::exists(name); });
    return file == files.end() ? "" : *file;
}

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

/// FreeType's library and the fonts, opened once a thread.
class Faces {
public:
    Faces() {
        const auto files = font_files();
        bool read = FT_Init_FreeType(&library_) == 0;
        for (const std::string& file : files) {
            FT_Face face = nullptr;
            read = read && FT_New_Face(library_, file.c_str(), 0, &face) == 0;
            if (!read) {
                throw failure("{}: expected a font, found a file that FreeType cannot read", file);
            }
            faces_.push_back(face);
        }
    }
    ~Faces() { FT_Done_FreeType(library_); } // and its faces
    Faces(const Faces&) = delete;
    Faces& operator=(const Faces&) = delete;

    FT_Face first() const { return faces_.front(); }
    /// The first font that has the letter; nothing where none has.
    FT_Face with(char32_t code) const {
        const auto face = std::find_if(faces_.begin(), faces_.end(), [&](FT_Face candidate) {
            return FT_Get_Char_Index(candidate, code) != 0;
        });
        return face == faces_.end() ? nullptr : *face;
    }

private:
    FT_Library library_ = nullptr;
    std::vector<FT_Face> faces_;
};

const Faces& faces() {
    thread_local const Faces opened;
    return opened;
}

/// The font that has a letter, else the first, at a size.
FT_Face sized_face(int size_px, char32_t code) {
    const FT_Face having = faces().with(code);
    const FT_Face face = having ? having : faces().first();
    if (FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size_px)) != 0) {
        throw failure("the font cannot be used at {} pixels", size_px);
    }
    return face;
}

constexpr int unit = 64; // FreeType counts in 64ths of a pixel

/// Load a letter into the face's glyph slot; give how far it moves the pen.
int advance_of(FT_Face face, char32_t code, FT_Int32 flags) {
    if (FT_Load_Char(face, code, flags) != 0) {
        throw failure("the letter U+{:04X} cannot be drawn", static_cast<std::uint32_t>(code));
    }
    return static_cast<int>(face->glyph->advance.x / unit);
}

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

std::vector<std::string> font_files() {
    std::vector<std::string> files{first_there(fonts)};
    if (files.front().empty()) {
        throw failure("the font {} is needed to draw text; found none (Debian package fonts-dejavu-core)",
                      fonts[0]);
    }
    if (const std::string further = first_there(further_fonts); !further.empty()) {
        files.push_back(further);
    }
    return files;
}

std::u32string code_points(std::string_view text) {
    std::u32string codes;
    while (!text.empty()) {
        codes += take_code_point(text);
    }
    return codes;
}

std::string letter_without_font(std::string_view text) {
    while (!text.empty()) {
        const std::string_view before = text;
        const char32_t code = take_code_point(text);
        if (code >= ' ' && !faces().with(code)) {
            return std::string(before.substr(0, before.size() - text.size()));
        }
    }
    return "";
}

int text_width(std::string_view text, int size_px) {
    // Layouts ask for the same letters over and over.
    thread_local std::map<std::pair<int, char32_t>, int> advances;
    int width = 0;
    while (!text.empty()) {
        const char32_t code = take_code_point(text);
        const auto [found, added] = advances.emplace(std::pair(size_px, code), 0);
        if (added) {
            found->second = advance_of(sized_face(size_px, code), code, FT_LOAD_DEFAULT);
        }
        width += found->second;
    }
    return width;
}

TextRaster text_raster(std::string_view text, int size_px) {
    TextRaster raster;
    raster.width = std::max(text_width(text, size_px), 1);
    const FT_Face metrics = sized_face(size_px, ' ');
    // Rounded up, so that no letter loses its top row or the last of a descender.
    raster.baseline = static_cast<int>((metrics->size->metrics.ascender + unit - 1) / unit) + 1;
    raster.height =
        raster.baseline + static_cast<int>((unit - 1 - metrics->size->metrics.descender) / unit) + 1;
    raster.coverage.assign(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height),
                           0);
    int pen_x = 0;
    while (!text.empty()) {
        const char32_t code = take_code_point(text);
        const FT_Face face = sized_face(size_px, code);
        const int advance = advance_of(face, code, FT_LOAD_RENDER);
        add_glyph(raster, face->glyph, pen_x, raster.baseline);
        pen_x += advance;
    }
    return raster;
}

} // namespace support
