// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stats/order.h>
#include <stats/study.h>

namespace stats {

/// An answer sooner than this after the second picture's onset was hardly given to the picture, in seconds.
inline constexpr double fast_answer_s = 0.3;

/// What tells how far a participant's answers can be trusted.
struct ParticipantQuality {
    std::string participant, file; ///< BIDS label; the run that counts
    bool complete = false;
    std::size_t trials = 0, missing = 0; ///< missing: without an answer
    std::size_t fast = 0;                ///< answers under fast_answer_s
    std::size_t errors = 0;              ///< answers that chose the test, not the reference
    OrderTally order;
    OrderTally both_orders; ///< of conditions answered in both orders
    Tally first_interval;   ///< choices of the first interval, freed from preference
    double p_first = 1;     ///< exact two-sided test of first against second interval
    double p_order = 1;     ///< order_p() of both_orders: a preference alone does not make it small
    double median_response_time_s = 0; ///< not a number where none is known
    std::optional<std::int64_t> dropped_frames;

    std::size_t answers() const { return trials - missing; }
    /// Always the same interval, in enough answers not to be chance, the reference first in some and second
    /// in others: with one order only, a preference looks the same.
    bool always_same_interval() const;
    /// Answers that hang on the order (p_order < .001), though not always the same interval.
    bool favours_interval() const;
};

/// One element each participant with a run that counts.
std::vector<ParticipantQuality> participant_quality(const Study& study);

/// Whatever a reader should know of the data, one sentence each; empty where there is nothing.
std::vector<std::string> quality_notes(const Study& study, std::span<const ParticipantQuality> participants);

/// The participants as tab-separated text.
std::string to_tsv(std::span<const ParticipantQuality> participants, bool simulated);

} // namespace stats
