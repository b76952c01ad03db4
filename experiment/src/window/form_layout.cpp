// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "form_layout.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include <fmt/format.h>

#include <support/error.h>

namespace experiment {
namespace {

// Over the large font's size.
constexpr float row_em = 1.9F, gap_em = 0.35F; // of choices, where there is room
constexpr float closest = 0.65F;               // that rows and gaps may shrink to
constexpr float field_em = 3;                  // a field to type into
constexpr float margins_em = 2.5F;             // heading, and room above the text
constexpr float least_lines = 3;               // of a text that scrolls

float width_of(const ImFont& font, const std::string& text) {
    return font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, text.c_str()).x;
}

float text_height(const Form& form, const ImFont& large, float width) {
    const float lines =
        large.CalcTextSizeA(large.FontSize, FLT_MAX, width, form.text.c_str()).y / large.FontSize;
    return lines * line_px(large) + large.FontSize;
}

} // namespace

FormLayout lay_out_form(const Form& form, const ImFont& large, float width, float height) {
    const float em = large.FontSize;
    const bool has_choices = !form.choices.empty();
    float answer = form.kind == Form::Kind::notice ? 0 : field_em * em;
    float scale = 1;
    const float needed = text_height(form, large, width);
    if (has_choices) {
        // A text that scrolls even above the closest choices leaves them their distances, if it keeps some
        // lines.
        const float rows = static_cast<float>(form.choices.size()) * (row_em + gap_em) * em;
        const float room = height - em;
        const bool scrolls = room - closest * rows < needed;
        const float wanted = scrolls ? least_lines * line_px(large) : needed;
        scale = std::clamp((room - wanted) / rows, closest, 1.0F);
        answer = scale * rows + em;
    }
    FormLayout layout;
    layout.row = scale * row_em * em;
    layout.gap = scale * gap_em * em;
    layout.text = height - answer;
    layout.whole = form.facts.empty() && form.warnings.empty() && needed < layout.text + 1; // rounding
    // Letters that scroll stay off the choices; a text that is whole has room of its own below it.
    layout.text = layout.whole ? needed : layout.text - em / 2;
    return layout;
}

void check_form(const Form& form, const FormFonts& fonts, const std::array<int, 2>& size,
                const std::string& field) {
    const float em = fonts.large->FontSize;
    const float width = std::round(column_share * static_cast<float>(size[0]));
    const float height = (1 - 2 * top_share) * static_cast<float>(size[1]) - (margins_em + foot_em) * em;
    const auto refuse = [&](const char* expected, const std::string& found) {
        throw support::input_error("{}: expected {} on a screen of {}x{} pixels, found {}", field, expected,
                                   size[0], size[1], found);
    };
    const auto check_line = [&](const std::string& text, const ImFont& font, float room) {
        if (width_of(font, text) > room) {
            refuse("words that fit on one line", fmt::format("\"{}\"", support::one_line(text)));
        }
    };
    for (std::size_t i = 0; i < form.choices.size(); ++i) {
        check_line(choice_label(i, form.choices[i]), *fonts.large, width - em);
    }
    check_line(form.heading, *fonts.small, width);
    check_line(form.missing, *fonts.large, width);
    check_line(form.more, *fonts.large, width);
    check_line(form.back + form.next, *fonts.small, width - 4 * em);
    if (form.kind == Form::Kind::integer) {
        check_line(range_label(form), *fonts.large, width - number_em * em);
    }
    const FormLayout layout = lay_out_form(form, *fonts.large, width, height);
    if (!layout.whole && layout.text < least_lines * line_px(*fonts.large)) {
        refuse("a text and choices that have room",
               fmt::format("{} choices below {} bytes of text", form.choices.size(), form.text.size()));
    }
}

} // namespace experiment
