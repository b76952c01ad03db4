// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "window_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <renderer/gl/context.h>

#include "../questionnaire.h"
#include "texts.h"

namespace experiment {
namespace {

constexpr int dropped_swaps = 10; // the first ones, while drivers and compositors settle
constexpr int measured_frames = 10;
constexpr int most_measurements = 5;
constexpr double poll_s = 0.5e-3; // pause between two looks at the keyboard
constexpr double quiet_s = 5e-3;  // before a deadline, no more looks
constexpr std::size_t rehearsed_swaps = 5;
constexpr double rehearsal_s = 0.2; // before a deadline
constexpr double rehearsal_pause_s = 0.015;
constexpr double least_rehearsed_s = 0.25; // shorter pictures leave no time for it

constexpr std::size_t flips_reserved = 100000; // so that none waits for memory

std::string name_of(const Picture& picture) {
    if (const auto* stimulus = std::get_if<Stimulus>(&picture)) {
        return study::stimulus_name(stimulus->shader, stimulus->distance, stimulus->azimuth_deg);
    }
    return std::holds_alternative<Grey>(picture) ? "grey" : "page";
}

} // namespace

WindowStage::WindowStage(const study::Protocol& protocol, std::size_t trials, const StimulusSet& set,
                         const ScreenOptions& options)
    : WindowStage(protocol, options, [&](Window& window) {
          check_texts(protocol, trials, window.framebuffer_size());
          // Show an empty page while the pictures are loaded.
          draw_page("", window.framebuffer_size());
          window.swap();
          return PictureStore(set, [&] { window.poll(); });
      }) {}

WindowStage::WindowStage(const study::Protocol& protocol, const std::map<Stimulus, Pixels>& pictures,
                         const ScreenOptions& options)
    : WindowStage(protocol, options, [&](Window&) { return PictureStore(pictures); }) {}

WindowStage::WindowStage(const study::Protocol& protocol, const ScreenOptions& options, const Load& load)
    : window_(protocol.image.width, protocol.image.height, options, protocol.session.leave),
      forms_(window_, form_texts(protocol), protocol.session.texts), texts_(protocol.session.texts),
      pictures_(load(window_)), least_size_{protocol.image.width, protocol.image.height} {
    flips_.reserve(flips_reserved);
    describe_screen(window_.monitor(), protocol, options, screen_);
    // From here on, time counts; loading was done by threads that may wait.
    screen_.scheduling = take_real_time_priority() ? "real-time" : "normal";
    measure_refresh();
    if (!refresh_.vsync) {
        screen_.warnings.push_back(
            fmt::format("swaps do not wait for a refresh (measured {:.0f} Hz, SD {:.1f} ms; "
                        "the monitor reports {} Hz): the clock paces, and pictures may tear",
                        refresh_.hz, 1000 * refresh_.sd_s, window_.reported_hz()));
    }
    renderer::gl::check_errors("opening the session's window");
}

/// Measure the refresh, anew where other programs disturbed it. A monitor that reports no rate has none.
void WindowStage::measure_refresh() {
    for (int attempt = 0; attempt < most_measurements && !refresh_.vsync; ++attempt) {
        refresh_ = judge_refresh(time_swaps(), window_.reported_hz());
        if (window_.reported_hz() == 0) {
            return;
        }
    }
}

std::vector<double> WindowStage::time_swaps() {
    std::vector<double> times_s;
    for (int i = 0; i < dropped_swaps + measured_frames + 1; ++i) {
        window_.poll();
        pictures_.draw(Grey{page_ground}, window_.framebuffer_size());
        window_.swap();
        window_.wait_for_back_buffer();
        if (i >= dropped_swaps) {
            times_s.push_back(monotonic_s());
        }
    }
    return times_s;
}

/// Look at keyboard and window once. What takes the screen from the trial disturbs it.
void WindowStage::look() {
    window_.poll();
    if (window_.take_close()) {
        forms_.confirm_leaving();
        throw Disturbed("the window was asked to close");
    }
    if (window_.take_change()) {
        wait_out_change();
        throw Disturbed("the screen changed");
    }
}

/// Wait until the framebuffer can hold a picture again.
void WindowStage::wait_out_change() {
    for (auto size = window_.framebuffer_size(); size[0] < least_size_[0] || size[1] < least_size_[1];
         size = window_.framebuffer_size()) {
        Form form;
        form.id = "screen";
        form.text = texts_.screen;
        form.facts = {
            {"px", fmt::format("{} x {} < {} x {}", size[0], size[1], least_size_[0], least_size_[1])}};
        form.next = texts_.next;
        forms_.ask(form);
    }
}

/// Look at the window until shortly before the deadline, then do nothing else but wait for it.
void WindowStage::wait_until_polling(double deadline_s) {
    while (monotonic_s() < deadline_s - quiet_s) {
        look();
        sleep_until(monotonic_s() + poll_s);
    }
    wait_until(deadline_s);
}

double WindowStage::show_after(double duration_s, const Picture& picture) {
    const Flip flip =
        refresh_.vsync ? show_by_refresh(duration_s, picture) : show_by_clock(duration_s, picture);
    note_flip(flip, picture);
    onset_s_ = flip.onset_s;
    current_ = picture;
    window_.take_damage(); // all is drawn anew
    renderer::gl::check_errors("showing a picture");
    return onset_s_;
}

/// Swap the buffers and wait for the refresh that shows what was drawn; `since_s` is the refresh before.
Flip WindowStage::swap_at_refresh(double since_s) {
    Flip flip;
    flip.asked_s = since_s + 1 / refresh_.hz;
    flip.called_s = monotonic_s();
    window_.swap();
    window_.wait_for_back_buffer();
    flip.onset_s = monotonic_s();
    flip.missed_frames = missed_frames(flip.onset_s - since_s, 1, refresh_.hz);
    return flip;
}

/// Show what is shown again at each refresh until one is left of so many frames, so that they are counted
/// and a dropped one is noticed; the time of the last refresh.
double WindowStage::hold(int frames) {
    double last_s = onset_s_;
    for (int shown = 1; shown < frames;) {
        look();
        pictures_.draw(current_, window_.framebuffer_size());
        Flip flip = swap_at_refresh(last_s);
        shown += std::max(1, static_cast<int>(std::lround((flip.onset_s - last_s) * refresh_.hz)));
        flip.frame = static_cast<std::size_t>(shown);
        note_flip(flip, current_);
        last_s = flip.onset_s;
    }
    return last_s;
}

Flip WindowStage::show_by_refresh(double duration_s, const Picture& picture) {
    if (duration_s > 0) {
        const double last_s = hold(whole_frames(duration_s, refresh_.hz));
        pictures_.draw(picture, window_.framebuffer_size());
        return swap_at_refresh(last_s);
    }
    // What comes at no given time misses no refresh.
    pictures_.draw(picture, window_.framebuffer_size());
    const double now_s = monotonic_s();
    Flip flip = swap_at_refresh(now_s);
    flip.asked_s = now_s;
    flip.missed_frames = 0;
    return flip;
}

void WindowStage::note_flip(Flip flip, const Picture& picture) {
    flip.trial = trial_;
    flip.picture = name_of(picture);
    dropped_frames_ += flip.missed_frames;
    flips_.push_back(std::move(flip));
}

Flip WindowStage::show_by_clock(double duration_s, const Picture& picture) {
    const double deadline_s = onset_s_ + duration_s;
    if (duration_s > least_rehearsed_s) {
        wait_until_polling(deadline_s - rehearsal_s);
        rehearse(deadline_s - rehearsal_s / 3);
    }
    pictures_.draw(picture, window_.framebuffer_size());
    Flip flip;
    flip.asked_s = duration_s > 0 ? deadline_s : monotonic_s();
    if (duration_s > 0) {
        // Begin the swap so early that it ends when the duration does.
        wait_until_polling(deadline_s - swap_duration_s_);
    }
    flip.called_s = monotonic_s();
    window_.swap();
    flip.onset_s = monotonic_s();
    return flip;
}

/// Measure how long a swap takes now by showing again what is shown already; without a refresh to wait for, a
/// swap is a copy, as fast as the machine has time for it.
void WindowStage::rehearse(double until_s) {
    std::vector<double> durations_s;
    while (durations_s.empty() || (durations_s.size() < rehearsed_swaps && monotonic_s() < until_s)) {
        pictures_.draw(current_, window_.framebuffer_size());
        wait_until(monotonic_s() + rehearsal_pause_s); // as before the swap that counts
        const double before_s = monotonic_s();
        window_.swap();
        durations_s.push_back(monotonic_s() - before_s);
    }
    swap_duration_s_ = median(durations_s);
}

/// Presses of 1 and 2 while a pair's second picture is still to come are no answers.
void WindowStage::count_early_answers() {
    if (trial_started_ && window_.pressed({Key::one, Key::two})) {
        ++early_answers_;
    }
}

Press WindowStage::wait_for(std::initializer_list<Key> keys) {
    // Presses before now answered nothing that was asked.
    look();
    count_early_answers();
    window_.clear_presses();
    trial_started_ = std::holds_alternative<Stimulus>(current_) && *keys.begin() == Key::space;
    double last_look_s = monotonic_s();
    while (true) {
        look();
        const double now_s = monotonic_s();
        const double pause_s = now_s - std::exchange(last_look_s, now_s);
        worst_key_delay_s_ = std::max(worst_key_delay_s_, pause_s);
        looked_s_ += pause_s;
        ++looks_;
        if (const auto press = window_.pressed(keys)) {
            count_early_answers();
            window_.clear_presses();
            return *press;
        }
        if (window_.take_damage()) {
            pictures_.draw(current_, window_.framebuffer_size());
            window_.swap();
        }
        sleep_until(now_s + poll_s);
    }
}

FormAnswer WindowStage::ask(const Form& form) { return forms_.ask(form); }

bool WindowStage::tell_trouble(const std::string& message) {
    return forms_.ask(trouble_form(texts_, message)).chosen.front() == 0;
}

StageFacts WindowStage::facts() const {
    StageFacts facts = screen_;
    facts.pacing = refresh_.vsync ? "vsync" : "clock";
    facts.gl_renderer = renderer::gl::driver_info().renderer;
    facts.resolution_px = window_.framebuffer_size();
    if (looks_ > 0) {
        facts.key_resolution_s = looked_s_ / static_cast<double>(looks_);
        facts.worst_key_delay_s = worst_key_delay_s_;
    }
    if (refresh_.vsync) {
        facts.refresh_hz = refresh_.hz;
        facts.dropped_frames = dropped_frames_;
    }
    return facts;
}

} // namespace experiment
