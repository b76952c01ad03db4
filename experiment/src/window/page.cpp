// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "page.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>

#include <support/error.h>
#include <support/text_raster.h>

namespace experiment {
namespace {

constexpr double text_share = 0.9;                      // of the page's width and height
constexpr int largest_divisor = 30, least_divisor = 70; // page height over font size
constexpr int unbroken_divisor = 40;                    // smallest letters that are worth unbroken lines
constexpr int smallest_font_px = 6;
constexpr double line_spacing = 1.45; // line height over font size
constexpr std::size_t announcement_lines = 4;

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
    if (support::text_width(line, font_px) <= most_px) {
        return {line};
    }
    std::vector<std::string> parts;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
        if (!parts.empty() && support::text_width(parts.back() + " " + word, font_px) <= most_px) {
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
        block_width = std::max(block_width, support::text_width(line, font_px));
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
            {line, (width - (centred ? support::text_width(line, font_px) : block_width)) / 2, baseline});
        baseline += line_px;
    }
    return layout;
}

std::uint8_t byte_of(double level) { return static_cast<std::uint8_t>(std::lround(255 * level)); }

/// Blend a line's letters into the page, where they lie inside it.
void draw_line(Pixels& page, const PageLayout::Line& line, int font_px) {
    const support::TextRaster raster = support::text_raster(line.text, font_px);
    for (int row = 0; row < raster.height; ++row) {
        const int y = line.baseline - raster.baseline + row;
        for (int column = 0; column < raster.width; ++column) {
            const int x = line.left + column;
            const int cover = raster.coverage[static_cast<std::size_t>(row * raster.width + column)];
            if (cover == 0 || x < 0 || x >= page.width || y < 0 || y >= page.height) {
                continue;
            }
            const std::uint8_t level = byte_of(page_ground + (page_ink - page_ground) * cover / 255);
            std::fill_n(&page.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(page.width) +
                                        static_cast<std::size_t>(x))],
                        3, level);
        }
    }
}

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
    for (const PageLayout::Line& line : layout.lines) {
        draw_line(page, line, layout.font_px);
    }
    return page;
}

} // namespace experiment
