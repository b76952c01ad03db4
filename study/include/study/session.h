// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace study {

/// How a question is answered: a whole number, one of several choices, any number of them, a line of text.
enum class QuestionKind { integer, choice, multiple, text };

/// A question to the participant, asked once before the first session.
struct Question {
    std::string id;   ///< names the column of the answers
    std::string text; ///< UTF-8, as asked
    QuestionKind kind = QuestionKind::text;
    int least = 0, most = 0;               ///< of a whole number
    std::string units = {};                ///< of a whole number; may be empty
    std::vector<std::string> choices = {}; ///< as shown, at most most_choices
    std::vector<std::string> values = {};  ///< as written to the answers, one a choice
    bool optional = false;                 ///< may be left without answer

    /// The place of the choice of value "none", which excludes the others; their number where there is none.
    std::size_t none_place() const;
};

constexpr std::size_t most_choices = 9; ///< each has a digit of its own

/// Keys that are pressed together, for what must not happen by accident.
struct KeyChord {
    bool ctrl = false, shift = false, alt = false;
    char key = 0; ///< a lower-case letter or a digit, as printed on the keyboard
};

/// The chord as people read it: "Ctrl+Shift+Q".
std::string text_of(const KeyChord& chord);

/// Pages and words of a session, UTF-8; {trial} and {trials} stand for numbers. An empty consent asks for
/// none.
struct SessionTexts {
    std::string consent, agree, decline, declined;
    std::string instructions, practice, practice_end, trial, early, pause, end;
    std::string next, back, question, missing, wrong, more;
    std::string trouble, try_again, stop, close, go_on, screen,
        waiting; ///< what happens unasked, and what can be done
};

struct SessionSettings {
    std::string reference;          ///< the shader all others are compared against
    std::vector<std::string> tests; ///< the shaders compared with it
    bool both_orders = true;        ///< each pair twice, once with either shader first
    bool immediate_repeats = true;  ///< whether one condition may follow itself
    int practice = 0;               ///< trials before the first that counts
    int pause_every = 0;            ///< trials between two breaks; 0: none
    double grey_s = 2;
    double grey_level = 0.5; ///< of the display signal (sRGB), not of the light
    KeyChord leave;          ///< ends the session, for the experimenter
    std::vector<Question> questions;
    SessionTexts texts;
};

} // namespace study
