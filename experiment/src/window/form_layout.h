// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cmath>
#include <string>

#include <imgui.h>

#include "../form.h"
#include "form_style.h"

namespace experiment {

// A form's lengths over the large font's size, and shares of the window.
constexpr float column_share = 0.72F; // of the window's width
constexpr float top_share = 0.08F;    // of its height, as much below
constexpr float foot_em = 3.2F;       // height of the last line's room

/// From line to line, in whole pixels: ImGui rounds places towards zero, so that fractions would make what is
/// above the screen longer than what is on it.
inline float line_px(const ImFont& font) { return std::round(1.35F * font.FontSize); }

/// How a form's room is shared, in pixels.
struct FormLayout {
    float text = 0;         ///< height of the text's room
    bool whole = true;      ///< whether all of the text fits there; else it scrolls
    float row = 0, gap = 0; ///< height of a choice, and of what is between two
};

/// Share `height` pixels, those between heading and foot, among a text and its answers: the text keeps its
/// height where that is possible, with choices closer together where that helps.
FormLayout lay_out_form(const Form& form, const ImFont& large, float width, float height);

/// Refuse a form that a window of that size cannot show: a word of it that is too long for its line, or so
/// many choices that too little of the text is left. Throws support::InputError that names `field`.
void check_form(const Form& form, const FormFonts& fonts, const std::array<int, 2>& size,
                const std::string& field);

} // namespace experiment
