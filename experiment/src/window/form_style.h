// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <imgui.h>

#include "../form.h"

namespace experiment {

// The colours of pages, and one that lights what is chosen; levels of the display signal.
inline const ImVec4 ink{0.85F, 0.85F, 0.85F, 1}, dim_ink{0.62F, 0.62F, 0.62F, 1},
    lit_ink{0.97F, 0.97F, 0.97F, 1}, warning_ink{0.93F, 0.74F, 0.42F, 1},
    field_ground{0.22F, 0.22F, 0.22F, 1}, hovered_ground{0.27F, 0.27F, 0.27F, 1},
    accent{0.25F, 0.42F, 0.55F, 1};
constexpr float name_em = 8.5F, warning_em = 1.2F; // columns of the start page, over the font's size
constexpr float number_em = 6;                     // width of a field for a number

struct FormFonts {
    ImFont *large = nullptr, *small = nullptr;
};

/// Load the letters that the texts need, and those that a participant may type, at two sizes that suit a
/// window so many pixels high. Throws support::Failure where the font is missing.
FormFonts load_fonts(const std::vector<std::string>& texts, int height_px);

/// The same fonts without a window, to measure words with.
class TemporaryFonts {
public:
    /// As load_fonts.
    TemporaryFonts(const std::vector<std::string>& texts, int height_px);
    ~TemporaryFonts();
    TemporaryFonts(const TemporaryFonts&) = delete;
    TemporaryFonts& operator=(const TemporaryFonts&) = delete;
    const FormFonts& get() const { return fonts_; }

private:
    ImGuiContext *before_, *own_;
    FormFonts fonts_;
};

/// A choice as its button shows it, with the digit that chooses it.
std::string choice_label(std::size_t place, const std::string& choice);

/// What is said beside a field for a whole number.
std::string range_label(const Form& form);

/// Colours and distances; `font_px` is the large font's size.
void apply_style(float font_px);

} // namespace experiment
