// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "../schedule.h"
#include "durable_file.h"

namespace experiment {

/// An answered trial; times in seconds, onsets since the session's start.
struct Answer {
    Trial trial;
    int response = 0;           ///< 1 or 2
    double response_time_s = 0; ///< from the onset of the second picture
    double onset_first_s = 0, onset_grey_s = 0, onset_second_s = 0;
};

/// The log's first line, without its end.
extern const std::string_view log_header;

/// The log's line for the answer to the `number`th trial, with its end.
std::string log_row(std::size_t number, const Answer& answer);

/// One run's log: SUB/beh/sub-LABEL_task-skin2afc_run-NN_beh.tsv, and its sidecar of the same name with
/// .json. It is created once, never overwritten, and each answer is on the disk when append() returns.
class SessionLog {
public:
    /// Create the participant's next run in a study folder; of two programs that do so at once, each gets its
    /// own. Throws support::Failure.
    static SessionLog create(const fs::path& study, const std::string& label);

    /// Throws support::Failure; the answers before stay as they were.
    void append(const Answer& answer);

    /// Answers on the disk.
    std::size_t answers() const { return answers_; }
    const fs::path& path() const { return file_.path(); }
    fs::path sidecar_path() const { return fs::path(path()).replace_extension(".json"); }

private:
    explicit SessionLog(DurableFile file) : file_(std::move(file)) {}

    DurableFile file_;
    std::size_t answers_ = 0;
};

} // namespace experiment
