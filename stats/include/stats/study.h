// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <stats/log.h>

namespace stats {

/// What the analysis needs of a run's sidecar; what it does not say is absent or empty.
struct Sidecar {
    std::optional<std::int64_t> trials_planned, dropped_frames;
    std::string protocol, protocol_digest; ///< name; SHA-256 of the file
    std::string stimuli;                   ///< the first 12 digits of the stimuli's manifest's SHA-256
    bool simulated = false;
};

/// One run of one participant.
struct Run {
    std::string participant; ///< BIDS label, without "sub-"
    std::int64_t number = 1; ///< 1 where the file's name has no run
    std::string file;        ///< relative to the study's folder
    Log log;
    Sidecar sidecar;

    /// Set by choose_runs: the trials of a complete run, whether they are there, whether the run counts, and
    /// why it does not.
    std::size_t trials_expected = 0;
    bool complete = false, used = false;
    std::string why_left_out;
};

/// A file that is not as the format has it, and was left out on request.
struct BadFile {
    std::string file; ///< relative to the study's folder
    std::string why;
};

/// A study's logs.
struct Study {
    std::string name;                                  ///< of dataset_description.json, else of the folder
    bool simulated = false;                            ///< dataset_description.json says so
    std::vector<Run> runs;                             ///< by participant, then by run
    std::vector<std::string> participants_without_log; ///< BIDS labels
    std::vector<BadFile> bad_files;
    std::size_t protocols =
        0; ///< different protocol files among the runs that count; those that name none aside
};

/// What to do about logs that are not as they should be.
struct Leniency {
    bool skip_bad = false;        ///< leave bad files out and list them, rather than refuse the study
    bool mixed_protocols = false; ///< take runs of different protocol files together
};

/// Mark the runs that count: of each participant's the last complete one, or, where none is complete, the
/// last that holds trials. Complete is a run with the trials its sidecar plans or, without one, with as many
/// as the longest log of the study. The runs stand by participant, then by run.
void choose_runs(std::vector<Run>& runs);

/// Read a study's folder (BIDS) and choose its runs. Throws support::InputError for a folder that is missing
/// or holds no answer, and for the first log or sidecar that is not as the format has it, whose name BIDS
/// does not allow, or whose protocol is not that of most runs.
Study read_study(const std::filesystem::path& folder, const Leniency& leniency = {});

/// What the runs that count hold.
struct Contents {
    std::size_t participants = 0, trials = 0, unanswered = 0;
    std::size_t simulated_runs = 0, runs = 0;
};
Contents contents(const Study& study);

/// Whether any of the data that count are simulated.
bool is_simulated(const Study& study);

} // namespace stats
