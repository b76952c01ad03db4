// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "form.h"
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
    std::string pacing = "n/a";      ///< "vsync", "clock" or "simulated"
    std::string gl_renderer = "n/a"; ///< OpenGL's name for the device
    std::optional<double> refresh_hz;
    std::optional<std::array<int, 2>> resolution_px;
    std::optional<double> key_resolution_s;  ///< mean time between two looks at the keyboard so far
    std::optional<double> worst_key_delay_s; ///< longest time between two looks so far
    std::optional<int> dropped_frames;       ///< so far; known only where the display's refresh paces
    std::optional<std::string> observer;     ///< of a simulated participant
    std::optional<std::string> observer_digest;
    std::string monitor = "n/a";
    std::optional<std::array<double, 2>> screen_size_mm;
    std::optional<double> viewing_distance_mm;
    std::optional<double> stimulus_width_deg; ///< visual angle
    std::vector<std::string> warnings;        ///< what may spoil the session, one line each
};

/// Something that happened beside the procedure.
struct Note {
    double time_s = 0; ///< on the stage's clock
    std::string what;  ///< for the sidecar
};

/// A picture that was put on the screen, or was shown there again at a further refresh.
struct Flip {
    std::size_t trial = 0;                         ///< from 1; 0 before the first
    std::string picture;                           ///< "page", "grey" or the stimulus's name
    double asked_s = 0, called_s = 0, onset_s = 0; ///< when it was due, when the swap began, when it was over
    int missed_frames = 0;                         ///< known only where the display's refresh paces
    std::size_t frame = 1;                         ///< of this picture; above 1 where it was shown again
};

/// The session was ended from outside, by a closed window or a signal; what() says by which.
class Interrupted : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A trial was disturbed before it was answered, and has to be shown again; what() says by what.
class Disturbed : public std::runtime_error {
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
    /// Show the picture when the one on the stage has lasted so long; returns its onset. Throws Interrupted,
    /// Disturbed.
    virtual double show_after(double duration_s, const Picture& picture) = 0;
    /// Wait until one of the keys is pressed anew, however often others are. Throws Interrupted, Disturbed.
    virtual Press wait_for(std::initializer_list<Key> keys) = 0;
    /// Show a form until it has an answer that will do. Throws Interrupted.
    virtual FormAnswer ask(const Form& form) = 0;
    /// Say that something failed; whether it should be tried again. Throws Interrupted.
    virtual bool tell_trouble(const std::string& message) = 0;
    virtual StageFacts facts() const = 0;
    virtual double now_s() const = 0;

    /// Say which trial comes; 0 for none.
    virtual void begin_trial(std::size_t) {}
    /// What has happened since the last call.
    virtual std::vector<Note> take_notes() { return {}; }
    /// How often, since the last call, an answer was given to a pair before its second picture was shown.
    virtual int take_early_answers() { return 0; }
    /// Every picture shown so far.
    virtual std::vector<Flip> flips() const { return {}; }
};

} // namespace experiment
