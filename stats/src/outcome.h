// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <string>

#include <stats/figures.h>

namespace stats {

/// What the figures of a row of a table show with the participants as the sample.
struct Outcome {
    enum class Kind {
        differs,   ///< the sign-flip p, by Holm's method over the rows of the table, is at most alpha
        as_good,   ///< it is not, and the two one-sided t-tests place the mean within the bounds
        undecided, ///< neither
        untestable ///< too few participants for any sign-flip p to be at most alpha
    };
    Kind kind = Kind::undecided;
    bool within_bounds = false;       ///< the two one-sided t-tests are significant
    bool reference_preferred = false; ///< by most answers
    std::string why;                  ///< it is untestable, or undecided for a reason of its own; else empty

    bool differs() const { return kind == Kind::differs; }
    bool differs_beyond_bounds() const { return differs() && !within_bounds; }
};
Outcome outcome_of(const Figures& figures);

/// The fewest participants whose sign-flip test can be significant by Holm's method over so many tests.
std::size_t fewest_participants(std::size_t tests);

/// The sign-flip p for running text, with its standard error where it was drawn: "= 0.168",
/// "= 0.064 (drawn at random, standard error 0.0011)".
std::string sign_flip_phrase(const SignFlip& flip);

/// "1 participant", "16 participants".
std::string participants_text(std::size_t count);

} // namespace stats
