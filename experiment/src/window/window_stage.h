// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include <study/protocol.h>

#include "../stage.h"
#include "../stimulus_set.h"
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
    WindowStage(const study::Protocol& protocol, const Schedule& schedule, const StimulusSet& set,
                bool windowed);

    double show_after(double duration_s, const Picture& picture) override;
    Press wait_for(std::initializer_list<Key> keys) override;
    StageFacts facts() const override;

private:
    PictureStore load(const study::Protocol& protocol, const Schedule& schedule, const StimulusSet& set);
    void measure_refresh();
    void wait_until_polling(double deadline_s);
    void rehearse(double until_s);
    double show_by_refresh(double duration_s, const Picture& picture);
    double show_by_clock(double duration_s, const Picture& picture);

    Window window_;
    PictureStore pictures_;
    Refresh refresh_;
    Picture current_ = Page{};
    double swap_duration_s_ = 0; // where the clock paces
    double onset_s_ = 0, worst_key_delay_s_ = 0;
    int dropped_frames_ = 0;
};

} // namespace experiment
