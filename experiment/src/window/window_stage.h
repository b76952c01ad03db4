// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <study/protocol.h>

#include "../session.h"
#include "../stage.h"
#include "../stimulus_set.h"
#include "form_view.h"
#include "pacing.h"
#include "picture_store.h"
#include "window.h"

namespace experiment {

/// The stage that a person sits before. Where swaps wait for the display's refresh, that paces it, and the
/// grey lasts a whole number of frames; elsewhere the clock does.
class WindowStage : public Stage {
public:
    /// Open the window, upload every picture, measure the refresh. Throws support::InputError for a screen
    /// that is too small, a picture that does not decode, or a text too long for a page; support::Failure
    /// without display or OpenGL 4.5; Interrupted.
    WindowStage(const study::Protocol& protocol, std::size_t trials, const StimulusSet& set,
                const ScreenOptions& options);

    /// The same with pictures of its own, and without texts.
    WindowStage(const study::Protocol& protocol, const std::map<Stimulus, Pixels>& pictures,
                const ScreenOptions& options);

    double show_after(double duration_s, const Picture& picture) override;
    Press wait_for(std::initializer_list<Key> keys) override;
    FormAnswer ask(const Form& form) override;
    bool tell_trouble(const std::string& message) override;
    StageFacts facts() const override;
    double now_s() const override { return monotonic_s(); }
    void begin_trial(std::size_t trial) override { trial_ = trial; }
    std::vector<Note> take_notes() override;
    int take_early_answers() override { return std::exchange(early_answers_, 0); }
    std::vector<Flip> flips() const override { return flips_; }
    const Refresh& refresh() const { return refresh_; }

private:
    using Load = std::function<PictureStore(Window&)>;
    WindowStage(const study::Protocol& protocol, const ScreenOptions& options, const Load& load);
    void measure_refresh();
    std::vector<double> time_swaps(int intervals);
    void measure_anew();
    void look();
    void wait_out_change();
    void count_early_answers();
    void wait_until_polling(double deadline_s);
    void rehearse(double until_s);
    Flip swap_at_refresh();
    void hold(int frames);
    int count_missed(std::size_t onset, double end_s);
    void note_flip(Flip flip, const Picture& picture);
    Flip show_by_refresh(double duration_s, const Picture& picture);
    Flip show_by_clock(double duration_s, const Picture& picture);

    Window window_;
    FormView forms_;
    study::SessionTexts texts_;
    PictureStore pictures_;
    StageFacts screen_;
    std::array<int, 2> least_size_; // of the framebuffer: the stimulus's
    Refresh refresh_;
    Picture current_ = Page{};
    std::vector<Flip> flips_;
    std::size_t trial_ = 0;
    std::vector<Note> notes_;
    bool remeasure_ = false;     // before the next page
    bool trial_started_ = false; // its second picture is still to come
    double swap_duration_s_ = 0; // where the clock paces
    double onset_s_ = 0;
    double worst_key_delay_s_ = 0, looked_s_ = 0; // between looks at the keyboard: the longest, all
    std::size_t looks_ = 0;
    int dropped_frames_ = 0, early_answers_ = 0;
};

} // namespace experiment
