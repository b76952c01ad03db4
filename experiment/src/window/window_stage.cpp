// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "window_stage.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <renderer/gl/context.h>

#include "../procedure.h"

namespace experiment {
namespace {

constexpr int dropped_swaps = 10; // the first ones, while drivers and compositors settle
constexpr int measured_frames = 10;
constexpr double poll_s = 0.5e-3;         // pause between two looks at the keyboard
constexpr double key_resolution_s = 1e-3; // pause, the look itself and a late waking
constexpr double quiet_s = 5e-3;          // before a deadline, no more looks
constexpr std::size_t rehearsed_swaps = 5;
constexpr double rehearsal_s = 0.2; // before a deadline
constexpr double rehearsal_pause_s = 0.015;
constexpr double least_rehearsed_s = 0.25; // shorter pictures leave no time for it

/// Refuse texts that would not fit before anything is shown.
void check_texts(const study::Protocol& protocol, std::size_t trials, const std::array<int, 2>& size) {
    const study::SessionTexts& texts = protocol.session.texts;
    for (const auto& [name, text] : {std::pair{"instructions", &texts.instructions},
                                     std::pair{"trial", &texts.trial}, std::pair{"end", &texts.end}}) {
        lay_out(fill_in(*text, trials, trials), size[0], size[1],
                fmt::format("{}: session.texts.{}", protocol.file.string(), name));
    }
}

} // namespace

WindowStage::WindowStage(const study::Protocol& protocol, const Schedule& schedule, const StimulusSet& set,
                         bool windowed)
    : window_(protocol.image.width, protocol.image.height, windowed),
      pictures_(load(protocol, schedule, set)) {
    measure_refresh();
    renderer::gl::check_errors("opening the session's window");
}

/// Show an empty page while the pictures are loaded.
PictureStore WindowStage::load(const study::Protocol& protocol, const Schedule& schedule,
                               const StimulusSet& set) {
    check_texts(protocol, schedule.size(), window_.framebuffer_size());
    draw_page("", window_.framebuffer_size());
    window_.swap();
    return PictureStore(set, [this] { window_.poll(); });
}

void WindowStage::measure_refresh() {
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
    refresh_ = judge_refresh(times_s, window_.reported_hz());
}

/// Look at the window until shortly before the deadline, then do nothing else but wait for it.
void WindowStage::wait_until_polling(double deadline_s) {
    while (monotonic_s() < deadline_s - quiet_s) {
        window_.poll();
        sleep_until(monotonic_s() + poll_s);
    }
    wait_until(deadline_s);
}

double WindowStage::show_after(double duration_s, const Picture& picture) {
    onset_s_ = refresh_.vsync ? show_by_refresh(duration_s, picture) : show_by_clock(duration_s, picture);
    current_ = picture;
    window_.take_damage(); // all is drawn anew
    renderer::gl::check_errors("showing a picture");
    return onset_s_;
}

double WindowStage::show_by_refresh(double duration_s, const Picture& picture) {
    // Have the picture ready in the back buffer before its time.
    pictures_.draw(picture, window_.framebuffer_size());
    double since_s = monotonic_s();
    int frames = 1;
    if (duration_s > 0) {
        // Ask for the swap half a period before the refresh that ends the last frame.
        since_s = onset_s_;
        frames = whole_frames(duration_s, refresh_.hz);
        wait_until_polling(since_s + (frames - 0.5) / refresh_.hz);
    }
    window_.swap();
    window_.wait_for_back_buffer();
    const double onset_s = monotonic_s();
    dropped_frames_ += missed_frames(onset_s - since_s, frames, refresh_.hz);
    return onset_s;
}

double WindowStage::show_by_clock(double duration_s, const Picture& picture) {
    const double deadline_s = onset_s_ + duration_s;
    if (duration_s > least_rehearsed_s) {
        wait_until_polling(deadline_s - rehearsal_s);
        rehearse(deadline_s - rehearsal_s / 3);
    }
    pictures_.draw(picture, window_.framebuffer_size());
    if (duration_s > 0) {
        // Begin the swap so early that it ends when the duration does.
        wait_until_polling(deadline_s - swap_duration_s_);
    }
    window_.swap();
    return monotonic_s();
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

Press WindowStage::wait_for(std::initializer_list<Key> keys) {
    // Presses before now answered nothing that was asked.
    window_.poll();
    window_.clear_presses();
    double last_look_s = monotonic_s();
    while (true) {
        window_.poll();
        const double now_s = monotonic_s();
        worst_key_delay_s_ = std::max(worst_key_delay_s_, now_s - std::exchange(last_look_s, now_s));
        if (const auto press = window_.pressed(keys)) {
            return *press;
        }
        if (window_.take_damage()) {
            pictures_.draw(current_, window_.framebuffer_size());
            window_.swap();
        }
        sleep_until(now_s + poll_s);
    }
}

StageFacts WindowStage::facts() const {
    StageFacts facts;
    facts.pacing = refresh_.vsync ? "vsync" : "clock";
    facts.gl_renderer = renderer::gl::driver_info().renderer;
    facts.resolution_px = window_.framebuffer_size();
    facts.key_resolution_s = key_resolution_s;
    facts.worst_key_delay_s = worst_key_delay_s_;
    if (refresh_.vsync) {
        facts.refresh_hz = refresh_.hz;
        facts.dropped_frames = dropped_frames_;
    }
    return facts;
}

} // namespace experiment
