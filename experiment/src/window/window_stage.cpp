// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "window_stage.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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
constexpr double rate_measured_s = 2;
constexpr double early_share = 0.35; // of a period, before which no swap that waits for its refresh returns
constexpr int most_early = 2;        // in a grey
constexpr double poll_s = 0.5e-3;    // pause between two looks at the keyboard
constexpr double quiet_s = 5e-3;     // before a deadline, no more looks
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
    remeasure_ = false;
    refresh_ = {};
    for (int attempt = 0; attempt < most_measurements && !refresh_.vsync; ++attempt) {
        refresh_ = judge_refresh(time_swaps(measured_frames), window_.reported_hz());
        if (window_.reported_hz() == 0) {
            return;
        }
    }
    // A grey of many frames needs the rate more exactly than ten intervals tell it.
    if (refresh_.vsync) {
        const auto frames = static_cast<int>(std::lround(rate_measured_s * refresh_.hz));
        refresh_.hz = rate_of(time_swaps(frames), refresh_.hz);
    }
}

std::vector<double> WindowStage::time_swaps(int intervals) {
    std::vector<double> times_s;
    for (int i = 0; i < dropped_swaps + intervals + 1; ++i) {
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

/// The display is not the one that was measured: measure it before the next trial, and say so.
void WindowStage::measure_anew() {
    measure_refresh();
    const std::string now =
        refresh_.vsync ? fmt::format("the refresh paces, {:.2f} Hz", refresh_.hz) : "the clock paces";
    notes_.push_back({monotonic_s(), "the display was measured anew: " + now});
}

/// Look at keyboard and window once. What takes the screen from the trial disturbs it.
void WindowStage::look() {
    window_.poll();
    if (window_.take_close()) {
        forms_.confirm_leaving();
        throw Disturbed("the window was asked to close");
    }
    if (window_.take_change()) {
        remeasure_ = window_.reported_hz() > 0;
        wait_out_change();
        throw Disturbed("the screen changed");
    }
}

/// Wait until the framebuffer can hold a picture again.
void WindowStage::wait_out_change() {
    for (auto size = window_.framebuffer_size(); size[0] < least_size_[0] || size[1] < least_size_[1];
         size = window_.framebuffer_size()) {
        forms_.ask(screen_form(
            texts_, fmt::format("{} x {} < {} x {}", size[0], size[1], least_size_[0], least_size_[1])));
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
    if (remeasure_ && std::holds_alternative<Page>(picture)) {
        measure_anew();
    }
    const Flip flip =
        refresh_.vsync ? show_by_refresh(duration_s, picture) : show_by_clock(duration_s, picture);
    note_flip(flip, picture);
    onset_s_ = flip.onset_s;
    current_ = picture;
    window_.take_damage(); // all is drawn anew
    renderer::gl::check_errors("showing a picture");
    return onset_s_;
}

/// Swap the buffers and wait for the refresh that shows what was drawn.
Flip WindowStage::swap_at_refresh() {
    Flip flip;
    flip.called_s = monotonic_s();
    window_.swap();
    window_.wait_for_back_buffer();
    flip.onset_s = monotonic_s();
    return flip;
}

/// Show what is shown again at each refresh until one is left of so many frames, so that they are counted.
/// Refreshes are numbered by the clock: should swaps no longer wait for them, the clock holds them back.
void WindowStage::hold(int frames) {
    int early = 0;
    for (int swaps = 1, shown = 1; shown < frames; ++swaps) {
        look();
        pictures_.draw(current_, window_.framebuffer_size());
        Flip flip = swap_at_refresh();
        flip.asked_s = onset_s_ + swaps / refresh_.hz;
        flip.frame = static_cast<std::size_t>(swaps) + 1;
        if (flip.onset_s < flip.asked_s - early_share / refresh_.hz) {
            ++early;
            wait_until(flip.asked_s);
        }
        shown = 1 + static_cast<int>(std::lround((monotonic_s() - onset_s_) * refresh_.hz));
        note_flip(std::move(flip), current_);
    }
    if (early > most_early) {
        notes_.push_back({monotonic_s(), "swaps no longer wait for the refresh that was measured"});
        remeasure_ = true;
    }
}

Flip WindowStage::show_by_refresh(double duration_s, const Picture& picture) {
    if (duration_s > 0) {
        const std::size_t onset = flips_.size() - 1;
        const int frames = whole_frames(duration_s, refresh_.hz);
        hold(frames);
        // Ask for the swap half a period before the refresh that ends the last frame.
        pictures_.draw(picture, window_.framebuffer_size());
        wait_until(onset_s_ + (frames - 0.5) / refresh_.hz);
        Flip flip = swap_at_refresh();
        flip.asked_s = onset_s_ + frames / refresh_.hz;
        flip.missed_frames = count_missed(onset, flip.onset_s);
        return flip;
    }
    // What comes at no given time misses no refresh.
    pictures_.draw(picture, window_.framebuffer_size());
    Flip flip = swap_at_refresh();
    flip.asked_s = flip.called_s;
    return flip;
}

/// Note which of the flips since `onset` came too late; how many refreshes the one at `end_s` missed.
int WindowStage::count_missed(std::size_t onset, double end_s) {
    std::vector<double> times_s;
    for (std::size_t i = onset; i < flips_.size(); ++i) {
        times_s.push_back(flips_[i].onset_s);
    }
    times_s.push_back(end_s);
    const std::vector<int> missed = missed_refreshes(times_s, refresh_.hz);
    for (std::size_t i = onset + 1; i < flips_.size(); ++i) {
        flips_[i].missed_frames = missed[i - onset - 1];
        dropped_frames_ += flips_[i].missed_frames;
    }
    return missed.back();
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

std::vector<Note> WindowStage::take_notes() {
    std::vector<Note> notes = window_.take_notes();
    std::ranges::move(std::exchange(notes_, {}), std::back_inserter(notes));
    return notes;
}

StageFacts WindowStage::facts() const {
    StageFacts facts = screen_;
    facts.pacing = refresh_.vsync ? "vsync" : "clock";
    facts.gl_renderer = renderer::gl::driver_info().renderer;
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
