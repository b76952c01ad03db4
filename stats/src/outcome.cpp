// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "outcome.h"

#include <cmath>

#include <fmt/format.h>

#include "labels.h"

namespace stats {
namespace {

/// Whether p was drawn at random and lies so near alpha that other draws might lie across it.
bool too_near(const ParticipantLevel& level) {
    constexpr double errors = 3;
    const SignFlip& flip = level.sign_flip;
    // The correction stretches the error as it does p.
    return !flip.exact &&
           std::abs(level.p_holm - alpha) <= errors * flip.standard_error * level.p_holm / flip.p;
}

} // namespace

Outcome outcome_of(const Figures& figures) {
    const ParticipantLevel& level = figures.participant;
    Outcome outcome;
    outcome.reference_preferred = figures.proportion > 0.5;
    if (level.participants < fewest_participants(1)) {
        outcome.kind = Outcome::Kind::untestable;
        outcome.why = fmt::format("with {}, no sign-flip test can be significant; it takes {}",
                                  participants_text(level.participants), fewest_participants(1));
        return outcome;
    }
    outcome.within_bounds = level.p_equivalence && *level.p_equivalence <= alpha;
    if (too_near(level)) {
        outcome.why = fmt::format("the drawn p lies within three standard errors of {}", alpha);
    } else if (level.p_holm <= alpha) {
        outcome.kind = Outcome::Kind::differs;
    } else if (outcome.within_bounds) {
        outcome.kind = Outcome::Kind::as_good;
    } else if (!level.p_equivalence) {
        outcome.why =
            "no difference is shown, and all participants have the same proportion, which leaves no "
            "spread to judge equality by";
    }
    return outcome;
}

std::size_t fewest_participants(std::size_t tests) {
    std::size_t count = 1;
    while (static_cast<double>(tests) * least_sign_flip_p(count) > alpha) {
        ++count;
    }
    return count;
}

std::string sign_flip_phrase(const SignFlip& flip) {
    return p_phrase(flip.p) +
           (flip.exact ? "" : fmt::format(" (drawn at random, standard error {:.2g})", flip.standard_error));
}

std::string participants_text(std::size_t count) { return counted(count, "participant"); }

} // namespace stats
