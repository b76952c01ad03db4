// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace experiment {

/// An 8-bit RGBA picture, sRGB, first row on top.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Grey levels of a page, of the display signal: light text on a dark ground, so that the eyes stay adapted
/// to pictures on black.
constexpr double page_ground = 0.15, page_ink = 0.85;

/// How a text fits on a page; lengths in pixels.
struct PageLayout {
    struct Line {
        std::string text;
        int left, baseline;
    };
    int font_px = 0;
    std::vector<Line> lines;
};

/// Set a text: letters as large as fit, a 30th of the page's height at most, which reads well from 60 cm on a
/// desk's monitor. The text's own line breaks stay; where its lines are too long even for somewhat smaller
/// letters, they are broken at spaces. Throws support::InputError, naming `field`, for a text that does not
/// fit in the smallest letters, and support::Failure where the font is missing.
PageLayout lay_out(const std::string& text, int width, int height, const std::string& field);

/// The page as a picture; errors as lay_out.
Pixels render_page(const std::string& text, int width, int height);

} // namespace experiment
