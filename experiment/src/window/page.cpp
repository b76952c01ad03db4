// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>

#include <OpenImageIO/imagebufalgo.h>

#include <support/error.h>

namespace experiment {
namespace {

namespace algo = OIIO::ImageBufAlgo;

constexpr double text_share = 0.9;                      // of the page's width and height
constexpr int largest_divisor = 30, least_divisor = 70; // page height over font size
constexpr int unbroken_divisor = 40;                    // smallest letters that are worth unbroken lines
constexpr int smallest_font_px = 6;
constexpr double line_spacing = 1.45; // line height over font size
constexpr std::size_t announcement_lines = 4;

/// DejaVu Sans, which has the letters of most alphabets, where distributions put it.
const std::string& font() {
    static const std::string found = [] {
        constexpr std::array candidates{
            "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
            "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
            "/usr/share/fonts/dejavu/DejaVuSans.ttf",
            "/usr/share/fonts/TTF/DejaVuSans.ttf",
        };
        for (const char* candidate : candidates) {
            if (std::filesystem::exists(candidate)) {
                return std::string(candidate);
            }
        }
        throw support::failure("{}: expected the font DejaVu Sans (Debian package fonts-dejavu-core), found "
                               "none",
                               candidates.front());
    }();
    return found;
}

int width_of(const std::string& text, int font_px) {
    const OIIO::ROI roi = algo::text_size(text, font_px, font());
    return roi.defined() ? roi.width() : 0;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// Break a line at spaces so that no part is wider than the limit; a longer word stays whole.
std::vector<std::string> broken(const std::string& line, int font_px, int most_px) {
    if (width_of(line, font_px) <= most_px) {
        return {line};
    }
    std::vector<std::string> parts;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
        if (!parts.empty() && width_of(parts.back() + " " + word, font_px) <= most_px) {
            parts.back() += " " + word;
        } else {
            parts.push_back(word);
        }
    }
    return parts;
}

/// The layout in letters of one size, unless the lines are too long or too many.
std::optional<PageLayout> try_font(const std::vector<std::string>& lines, int font_px, int width,
                                   int height) {
    const int line_px = static_cast<int>(std::lround(line_spacing * font_px));
    const int block_height = static_cast<int>(lines.size()) * line_px;
    int block_width = 0;
    for (const std::string& line : lines) {
        block_width = std::max(block_width, width_of(line, font_px));
    }
    if (block_width > static_cast<int>(text_share * width) ||
        block_height > static_cast<int>(text_share * height)) {
        return std::nullopt;
    }
    // Centre the block, and in short announcements each line.
    const bool centred = lines.size() <= announcement_lines;
    PageLayout layout{.font_px = font_px, .lines = {}};
    int baseline = (height - block_height) / 2 + font_px;
    for (const std::string& line : lines) {
        layout.lines.push_back(
            {line, (width - (centred ? width_of(line, font_px) : block_width)) / 2, baseline});
        baseline += line_px;
    }
    return layout;
}

std::uint8_t byte_of(double level) { return static_cast<std::uint8_t>(std::lround(255 * level)); }

} // namespace

PageLayout lay_out(const std::string& text, int width, int height, const std::string& field) {
    const auto size = [&](int divisor) { return std::max(smallest_font_px, height / divisor); };
    const auto lines = lines_of(text);

    // Prefer the text's own lines, then larger letters.
    for (int font_px = size(largest_divisor); font_px >= size(unbroken_divisor); --font_px) {
        if (auto layout = try_font(lines, font_px, width, height)) {
            return *layout;
        }
    }
    for (int font_px = size(largest_divisor); font_px >= size(least_divisor); --font_px) {
        std::vector<std::string> parts;
        for (const std::string& line : lines) {
            std::ranges::move(broken(line, font_px, static_cast<int>(text_share * width)),
                              std::back_inserter(parts));
        }
        if (auto layout = try_font(parts, font_px, width, height)) {
            return *layout;
        }
    }
    throw support::input_error(
        "{}: expected a text that fits on a screen of {}x{} pixels, found {} bytes of it", field, width,
        height, text.size());
}

Pixels render_page(const std::string& text, int width, int height) {
    const PageLayout layout = lay_out(text, width, height, "page");
    Pixels page{width, height, {}};
    page.rgba.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                     byte_of(page_ground));
    OIIO::ImageBuf canvas(OIIO::ImageSpec(width, height, 4, OIIO::TypeDesc::UINT8), page.rgba.data());
    const auto ink = static_cast<float>(page_ink);
    for (const PageLayout::Line& line : layout.lines) {
        if (!line.text.empty() && !algo::render_text(canvas, line.left, line.baseline, line.text,
                                                     layout.font_px, font(), {ink, ink, ink, 1.0F})) {
            throw support::failure("a page of text cannot be rendered: {}", canvas.geterror());
        }
    }
    return page;
}

} // namespace experiment
