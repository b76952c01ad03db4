// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <string>
#include <vector>

#include <study/session.h>

#include "../form.h"
#include "form_layout.h"
#include "window.h"

struct ImFont;

namespace experiment {

/// Shows forms in a window and takes their answers, by keyboard or mouse.
class FormView {
public:
    /// `texts` hold every letter that forms will show. Throws support::Failure without a font.
    FormView(Window& window, const std::vector<std::string>& texts, const study::SessionTexts& words);
    ~FormView();
    FormView(const FormView&) = delete;
    FormView& operator=(const FormView&) = delete;

    /// Show a form until it has an answer that will do. Escape does nothing; closing the window asks. Throws
    /// Interrupted.
    FormAnswer ask(const Form& form);
    /// Ask whether the session should end. Throws Interrupted where it should.
    void confirm_leaving();

private:
    /// What is on the screen: the answer so far, whether it was found wanting, whether the text goes on below
    /// and whether its end was seen.
    struct State {
        FormAnswer answer = {};
        bool done = false, refused = false, goes_on = false, end_seen = false;
        int frames = 0;
        float scroll_lines = 0; ///< that keys have asked for
        bool pointer_moved = false;
        std::array<double, 2> pointer{}; ///< where it was when the form came
    };
    static void confirm(const Form& form, State& state);
    FormAnswer show(const Form& form, bool asks_to_close);
    void draw(const Form& form, State& state);
    void draw_body(const Form& form, const FormLayout& layout, State& state) const;
    void draw_facts(const Form& form) const;
    void draw_answer(const Form& form, const FormLayout& layout, State& state) const;
    void draw_choices(const Form& form, const FormLayout& layout, State& state) const;
    void draw_field(const Form& form, State& state) const;
    void draw_foot(const Form& form, State& state) const;
    std::array<double, 2> pointer() const;
    void heed_pointer(State& state) const;
    void take_keys(const Form& form, State& state);
    void render() const;

    Window& window_;
    const study::SessionTexts words_;
    std::vector<int> tapped_; // since the last frame but one
    ImFont *large_ = nullptr, *small_ = nullptr;
    float width_ = 0, height_ = 0; // of the framebuffer, px
};

} // namespace experiment
