// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "form_style.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <support/text_raster.h>

#include "page.h"

namespace experiment {
namespace {

// At 988 pixels and 0.25 mm a pixel, capitals of 0.63 of these sizes are seen from 60 cm under 28 and 21
// minutes of arc; ISO 9241-303 recommends 20 to 22.
constexpr int large_divisor = 31, small_divisor = 42; // window height over font size
constexpr int least_font_px = 9;

/// One font, with the letters that it lacks from the others.
ImFont* load_font(const ImVector<ImWchar>& letters, int size_px) {
    ImFont* font = nullptr;
    for (const std::string& file : support::font_files()) {
        ImFontConfig config;
        config.MergeMode = font != nullptr;
        ImFont* loaded = ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), static_cast<float>(size_px),
                                                                  &config, letters.Data);
        font = font ? font : loaded;
    }
    return font;
}

} // namespace

FormFonts load_fonts(const std::vector<std::string>& texts, int height_px) {
    // ImGui reads the ranges when it builds its atlas, so they must still be there.
    static ImVector<ImWchar> letters;
    letters.clear();
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFontGlyphRangesBuilder builder;
    constexpr ImWchar latin_extended[] = {0x100, 0x24f, 0x370, 0x3ff, 0x2010, 0x203a, 0x20a0, 0x20bf, 0};
    builder.AddRanges(atlas.GetGlyphRangesCyrillic()); // and Basic Latin
    builder.AddRanges(latin_extended);
    for (const std::string& text : texts) {
        builder.AddText(text.c_str());
    }
    builder.BuildRanges(&letters);
    const FormFonts fonts{load_font(letters, std::max(least_font_px, height_px / large_divisor)),
                          load_font(letters, std::max(least_font_px, height_px / small_divisor))};
    atlas.Build();
    return fonts;
}

TemporaryFonts::TemporaryFonts(const std::vector<std::string>& texts, int height_px)
    : before_(ImGui::GetCurrentContext()), own_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(own_);
    try {
        fonts_ = load_fonts(texts, height_px);
    } catch (...) {
        ImGui::DestroyContext(own_);
        ImGui::SetCurrentContext(before_);
        throw;
    }
    ImGui::SetCurrentContext(before_);
}

TemporaryFonts::~TemporaryFonts() {
    ImGui::DestroyContext(own_);
    ImGui::SetCurrentContext(before_);
}

std::string choice_label(std::size_t place, const std::string& choice) {
    return fmt::format("{}   {}", place + 1, choice);
}

std::string range_label(const Form& form) {
    return fmt::format("{} ({} – {})", form.units, form.least, form.most);
}

void apply_style(float font_px) {
    ImGuiStyle& style = ImGui::GetStyle();
    ImGui::StyleColorsDark();
    style.WindowPadding = {0, 0};
    style.WindowBorderSize = 0;
    style.FrameRounding = std::round(font_px / 6);
    style.FramePadding = {std::round(font_px / 2), std::round(font_px / 4)};
    style.ButtonTextAlign = {0, 0.5F};
    style.ItemSpacing = {font_px / 2, std::round(font_px / 5)};
    style.ScrollbarSize = font_px / 2;
    const auto ground = static_cast<float>(page_ground);
    style.Colors[ImGuiCol_WindowBg] = {ground, ground, ground, 1};
    style.Colors[ImGuiCol_Text] = ink;
    style.Colors[ImGuiCol_Button] = field_ground;
    style.Colors[ImGuiCol_ButtonHovered] = hovered_ground;
    style.Colors[ImGuiCol_ButtonActive] = accent;
    style.Colors[ImGuiCol_FrameBg] = field_ground;
    style.Colors[ImGuiCol_TextSelectedBg] = accent;
    style.Colors[ImGuiCol_ScrollbarBg] = {ground, ground, ground, 1};
    style.Colors[ImGuiCol_ScrollbarGrab] = dim_ink;
}

} // namespace experiment
