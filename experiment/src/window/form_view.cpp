// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "form_view.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "../questionnaire.h"
#include "form_layout.h"
#include "form_style.h"
#include "pacing.h"
#include "page.h"

namespace experiment {
namespace {

constexpr double frame_s = 0.01; // between two looks at the keyboard
constexpr double held_s = 0.3;   // before a key that is held down scrolls on
constexpr float held_lines = 15; // a second
constexpr float tapped_lines = 2, page_lines = 8;
constexpr int form_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;

/// Text broken at spaces, with more room between its lines than ImGui leaves.
void draw_lines(const std::string& text, float width) {
    const ImFont& font = *ImGui::GetFont();
    const char* const end = text.data() + text.size();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, line_px(font) - font.FontSize});
    for (const char* line = text.data(); line < end;) {
        const char* const paragraph = std::find(line, end, '\n');
        const char* const wrapped =
            line == paragraph ? line : font.CalcWordWrapPositionA(1, line, paragraph, width);
        ImGui::TextUnformatted(line, wrapped);
        // The space or the line's end that it was broken at is not shown.
        line = wrapped + (wrapped < end && (*wrapped == ' ' || *wrapped == '\n') ? 1 : 0);
    }
    ImGui::PopStyleVar();
}

/// How many lines a press of a key scrolls.
float scrolled_by(int key) {
    switch (key) {
    case GLFW_KEY_DOWN:
        return tapped_lines;
    case GLFW_KEY_UP:
        return -tapped_lines;
    case GLFW_KEY_PAGE_DOWN:
        return page_lines;
    case GLFW_KEY_PAGE_UP:
        return -page_lines;
    default:
        return 0;
    }
}

} // namespace

FormView::FormView(Window& window, const std::vector<std::string>& texts, const study::SessionTexts& words)
    : window_(window), words_(words) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // writes no file of its own
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    ImGui_ImplGlfw_InitForOpenGL(window_.handle(), true);
    window_.listen_to_monitors(); // ImGui passes all other events on, but not these
    ImGui_ImplOpenGL3_Init("#version 450 core");
    try {
        const FormFonts fonts = load_fonts(texts, window_.framebuffer_size()[1]);
        large_ = fonts.large;
        small_ = fonts.small;
    } catch (...) {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
        throw;
    }
    apply_style(large_->FontSize);
}

FormView::~FormView() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

FormAnswer FormView::ask(const Form& form) {
    window_.clear_presses();
    const FormAnswer answer = show(form, true);
    window_.hide_pointer();
    window_.clear_presses();
    return answer;
}

void FormView::confirm_leaving() {
    if (show(close_form(words_), false).chosen.front() == 1) {
        throw Interrupted("the window was closed");
    }
    window_.hide_pointer();
    window_.clear_presses();
}

FormAnswer FormView::show(const Form& form, bool asks_to_close) {
    State state{.answer = form.given};
    ImGui::GetIO().ClearInputCharacters();
    window_.hide_pointer();
    state.pointer = pointer();
    while (!state.done) {
        const double start_s = monotonic_s();
        window_.poll();
        window_.take_change(); // a form fits itself into any window
        if (asks_to_close && window_.take_close()) {
            confirm_leaving();
        }
        take_keys(form, state);
        if (!state.done) {
            draw(form, state);
        }
        sleep_until(start_s + frame_s);
    }
    return state.answer;
}

std::array<double, 2> FormView::pointer() const {
    std::array<double, 2> at{};
    glfwGetCursorPos(window_.handle(), &at[0], &at[1]);
    return at;
}

/// A pointer that lies where it was left points at nothing: it lights no choice until it is moved.
void FormView::heed_pointer(State& state) const {
    if (!state.pointer_moved && pointer() != state.pointer) {
        state.pointer_moved = true;
        glfwSetInputMode(window_.handle(), GLFW_CURSOR, GLFW_CURSOR_NORMAL);
    }
    if (!state.pointer_moved) {
        ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
    }
}

/// Take the answer if it will do and what it answers was on the screen.
void FormView::confirm(const Form& form, State& state) {
    const bool must_read =
        form.after_reading && std::find(state.answer.chosen.begin(), state.answer.chosen.end(),
                                        *form.after_reading) != state.answer.chosen.end();
    const bool read = state.end_seen || !must_read;
    state.done = read && will_do(form, state.answer);
    state.refused = read && !state.done;
}

/// Digits choose, Enter goes on, Page Up goes back, arrows scroll.
void FormView::take_keys(const Form& form, State& state) {
    // ImGui sees a key only where it is down at a frame: keep a key that was tapped between two frames down
    // for one.
    bool* const keys_down = ImGui::GetIO().KeysDown;
    for (const int key : std::exchange(tapped_, {})) {
        keys_down[key] = glfwGetKey(window_.handle(), key) == GLFW_PRESS;
    }
    for (const int key : window_.take_keys()) {
        if (key >= 0 && key <= GLFW_KEY_LAST) {
            keys_down[key] = true;
            tapped_.push_back(key);
        }
        const bool digit = key >= GLFW_KEY_1 && key <= GLFW_KEY_9;
        const bool keypad = key >= GLFW_KEY_KP_1 && key <= GLFW_KEY_KP_9;
        if ((digit || keypad) && !form.choices.empty()) {
            choose(form, static_cast<std::size_t>(key - (digit ? GLFW_KEY_1 : GLFW_KEY_KP_1)), state.answer);
        } else if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) {
            confirm(form, state);
        } else if (key == GLFW_KEY_PAGE_UP && form.can_go_back) {
            state.answer.back = true;
            state.done = true;
        } else {
            state.scroll_lines += scrolled_by(key);
        }
    }
    keys_down[GLFW_KEY_ESCAPE] = false; // it would empty a text field
}

void FormView::draw(const Form& form, State& state) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    heed_pointer(state);
    ImGui::NewFrame();
    const auto size = window_.framebuffer_size();
    width_ = static_cast<float>(size[0]);
    height_ = static_cast<float>(size[1]);
    const float column = std::round(column_share * width_);
    ImGui::SetNextWindowPos({std::round((width_ - column) / 2), std::round(top_share * height_)});
    ImGui::SetNextWindowSize({column, std::round((1 - 2 * top_share) * height_)});
    ImGui::Begin("form", nullptr, form_flags);
    ImGui::PushFont(small_);
    ImGui::TextColored(dim_ink, "%s", form.heading.c_str());
    ImGui::PopFont();
    ImGui::PushFont(large_);
    ImGui::Dummy({0, large_->FontSize / 2});
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const FormLayout layout = lay_out_form(form, *large_, room.x, room.y - foot_em * large_->FontSize);
    draw_body(form, layout, state);
    draw_answer(form, layout, state);
    draw_foot(form, state);
    ImGui::PopFont();
    ImGui::End();
    render();
}

/// The text, as high as it is, or scrolling where there is less room.
void FormView::draw_body(const Form& form, const FormLayout& layout, State& state) const {
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::BeginChild("text", {0, layout.text}, false, ImGuiWindowFlags_NoNav);
    // A scrollbar takes its width from the lines.
    draw_lines(form.text, layout.whole ? width : width - ImGui::GetStyle().ScrollbarSize);
    draw_facts(form);
    // Arrow keys scroll a text that is longer than its room: each press a little, and on while they are held.
    const ImGuiIO& io = ImGui::GetIO();
    for (const auto& [key, sign] : {std::pair{GLFW_KEY_DOWN, 1.0F}, std::pair{GLFW_KEY_UP, -1.0F}}) {
        if (io.KeysDown[key] && io.KeysDownDuration[key] > static_cast<float>(held_s)) {
            state.scroll_lines += sign * held_lines * io.DeltaTime;
        }
    }
    // ImGui knows how far a text scrolls when it was drawn before; till then it knows the last form's. What
    // keys ask for meanwhile is kept.
    constexpr int settled_frames = 3;
    if (++state.frames < settled_frames) {
        ImGui::SetScrollY(0);
    } else {
        const float scroll_px = std::exchange(state.scroll_lines, 0.0F) * line_px(*large_);
        if (scroll_px != 0) {
            ImGui::SetScrollY(std::clamp(ImGui::GetScrollY() + scroll_px, 0.0F, ImGui::GetScrollMaxY()));
        }
        state.goes_on = ImGui::GetScrollY() < ImGui::GetScrollMaxY() - 1;
        state.end_seen = state.end_seen || !state.goes_on;
    }
    ImGui::EndChild();
}

/// A table, and warnings below it, in small letters.
void FormView::draw_facts(const Form& form) const {
    if (form.facts.empty()) {
        return;
    }
    ImGui::PushTextWrapPos(0);
    ImGui::PushFont(small_);
    ImGui::Dummy({0, std::round(small_->FontSize / 2)});
    for (const auto& [name, value] : form.facts) {
        ImGui::TextColored(dim_ink, "%s", name.c_str());
        ImGui::SameLine(name_em * small_->FontSize);
        ImGui::TextUnformatted(value.c_str());
    }
    ImGui::Dummy({0, std::round(small_->FontSize / 2)});
    for (const std::string& warning : form.warnings) {
        ImGui::TextColored(warning_ink, "!");
        ImGui::SameLine(warning_em * small_->FontSize);
        ImGui::PushStyleColor(ImGuiCol_Text, warning_ink);
        ImGui::TextUnformatted(warning.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopFont();
    ImGui::PopTextWrapPos();
}

void FormView::draw_answer(const Form& form, const FormLayout& layout, State& state) const {
    if (form.kind == Form::Kind::choice || form.kind == Form::Kind::multiple) {
        draw_choices(form, layout, state);
    } else if (form.kind != Form::Kind::notice) {
        draw_field(form, state);
    }
}

/// One wide button a choice, with its digit; what is chosen is lit.
void FormView::draw_choices(const Form& form, const FormLayout& layout, State& state) const {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, layout.gap});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
    for (std::size_t i = 0; i < form.choices.size(); ++i) {
        const auto& chosen = state.answer.chosen;
        const bool lit = std::find(chosen.begin(), chosen.end(), i) != chosen.end();
        ImGui::PushStyleColor(ImGuiCol_Button, lit ? accent : field_ground);
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, lit ? accent : hovered_ground);
        ImGui::PushStyleColor(ImGuiCol_Text, lit ? lit_ink : ink);
        const std::string label = fmt::format("{}##{}", choice_label(i, form.choices[i]), i);
        if (ImGui::Button(label.c_str(), {ImGui::GetContentRegionAvail().x, layout.row})) {
            choose(form, i, state.answer);
        }
        ImGui::PopStyleColor(3);
    }
    ImGui::PopStyleVar(2);
}

void FormView::draw_field(const Form& form, State& state) const {
    const bool number = form.kind == Form::Kind::integer;
    ImGui::SetNextItemWidth(number ? number_em * large_->FontSize : ImGui::GetContentRegionAvail().x);
    if (!ImGui::IsAnyItemActive()) {
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::InputText("##field", &state.answer.text, number ? ImGuiInputTextFlags_CharsDecimal : 0);
    if (number) {
        ImGui::SameLine();
        ImGui::TextColored(dim_ink, "%s", range_label(form).c_str());
    }
}

/// What the keys do, as buttons for the mouse, and what is wrong with an answer.
void FormView::draw_foot(const Form& form, State& state) const {
    const float font = large_->FontSize;
    ImGui::SetCursorPosY(ImGui::GetWindowHeight() - foot_em * font);
    const bool out_of_range = form.kind == Form::Kind::integer && !state.answer.text.empty();
    const std::string& said = !state.refused ? form.more : out_of_range ? form.wrong : form.missing;
    ImGui::TextColored(warning_ink, "%s", state.refused || state.goes_on ? said.c_str() : "");
    ImGui::PushFont(small_);
    const auto width_of = [&](const std::string& label) {
        return ImGui::CalcTextSize(label.c_str()).x + 2 * font;
    };
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0.5F, 0.5F});
    if (form.can_go_back && ImGui::Button(form.back.c_str(), {width_of(form.back), 0})) {
        state.answer.back = state.done = true;
    }
    if (form.can_go_back) {
        ImGui::SameLine();
    }
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - width_of(form.next));
    if (ImGui::Button(form.next.c_str(), {width_of(form.next), 0})) {
        confirm(form, state);
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

void FormView::render() const {
    ImGui::Render();
    glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
    const auto ground = static_cast<float>(page_ground);
    glClearColor(ground, ground, ground, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    window_.swap();
}

} // namespace experiment
