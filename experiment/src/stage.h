// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "schedule.h"

namespace experiment {

/// A page of text, light on dark grey.
struct Page {
    std::string text; ///< UTF-8
};

/// The whole screen in one grey.
struct Grey {
    double level = 0.5; ///< of the display signal, 0 ... 1
};

/// Everything that a stage can show.
using Picture = std::variant<Page, Grey, Stimulus>;

/// A participant's key; the keypad's digits count as those of the number row.
enum class Key { space, one, two };

/// A key that was pressed, and when.
struct Press {
    Key key;
    double time_s; ///< on the stage's clock
};

/// What a stage knows of itself, for the sidecar; absent where it has no such thing.
struct StageFacts {
    std::string pacing;              ///< "vsync", "clock" or "simulated"
    std::string gl_renderer = "n/a"; ///< OpenGL's name for the device
    std::optional<double> refresh_hz;
    std::optional<std::array<int, 2>> resolution_px;
    std::optional<double> key_resolution_s;  ///< time between two looks at the keyboard
    std::optional<double> worst_key_delay_s; ///< longest time between two looks so far
    std::optional<int> dropped_frames;       ///< so far; known only where the display's refresh paces
    std::optional<std::string> observer;     ///< of a simulated participant
};

/// The session was ended from outside, by a closed window or a signal; what() says by which.
class Interrupted : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Where a session takes place: it shows pictures to a participant, takes key presses, and keeps the time.
/// Times are seconds on the stage's own steady clock, whose zero means nothing.
class Stage {
public:
    Stage() = default;
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    virtual ~Stage() = default;

    /// Show the picture at once; returns its onset.
    double show(const Picture& picture) { return show_after(0, picture); }
    /// Show the picture when the one on the stage has lasted so long; returns its onset. Throws Interrupted.
    virtual double show_after(double duration_s, const Picture& picture) = 0;
    /// Wait until one of the keys is pressed anew, however often others are. Throws Interrupted.
    virtual Press wait_for(std::initializer_list<Key> keys) = 0;
    virtual StageFacts facts() const = 0;
};

} // namespace experiment
