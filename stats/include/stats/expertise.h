// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stats/quality.h>
#include <stats/two_groups.h>

namespace stats {

/// One question on expertise, and who says to have it.
struct ExpertiseQuestion {
    std::string column, file;                   ///< file: relative to the study's folder
    std::map<std::string, bool> by_participant; ///< BIDS labels; those without an answer are left out
};

/// Read the questions on expertise from participants.tsv and phenotype/*.tsv: columns whose name has one of
/// the words expertise, expert, experience, experienced, graphics, art, arts, drawing, photography. An answer
/// that starts with the word no, none, never, false, n, f or 0 is none; n/a and an empty one are missing; all
/// else is expertise (yes, a list of fields). Throws support::InputError for a file that is no table with the
/// column participant_id, or that names a participant twice.
std::vector<ExpertiseQuestion> read_expertise(const std::filesystem::path& study);

/// Errors of one group of participants; an error is an answer for the test.
struct GroupErrors {
    std::size_t participants = 0, errors = 0, answers = 0;
    double median = 0; ///< of the participants' proportions of errors
};

/// Errors with and without an expertise, over participants [Jimenez2009, section 5.1].
struct ExpertiseComparison {
    std::string column, file;
    GroupErrors with, without;
    std::optional<RankSum> rank_sum; ///< of the participants' proportions of errors
    std::optional<WelchTest> welch;
};
std::vector<ExpertiseComparison> compare_expertise(std::span<const ExpertiseQuestion> questions,
                                                   std::span<const ParticipantQuality> participants);

/// The answer in a sentence.
std::string expertise_sentence(const ExpertiseComparison& comparison);

} // namespace stats
