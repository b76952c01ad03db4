// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "../schedule.h"
#include "durable_file.h"
#include "log_content.h"

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

/// The number of the participant's last run that has left a log or sidecar in a study; 0 where there is none.
int last_run(const fs::path& study, const std::string& label);
/// The log of a participant's run.
fs::path log_path(const fs::path& study, const std::string& label, int run);

/// One run's log: SUB/beh/sub-LABEL_task-skin2afc_run-NN_beh.tsv, and its sidecar of the same name with
/// .json. It is created once, never overwritten, written by one program at a time, and each answer is on the
/// disk when append() returns.
class SessionLog {
public:
    /// Create the participant's next run in a study folder; of two programs that do so at once, each gets its
    /// own. Throws support::Failure.
    static SessionLog create(const fs::path& study, const std::string& label);

    /// Go on with a run's log after its answers; settle() takes off what follows them. Throws
    /// support::InputError where another program writes to it, support::Failure.
    static SessionLog resume(const fs::path& path, const LogContent& content);
    /// Leave whole lines only: take off a torn one, end one without end. Throws support::Failure.
    void settle();

    /// Throws support::Failure; the answers before stay as they were.
    void append(const Answer& answer);
    /// Where the log was deleted or moved meanwhile, write it anew. Throws support::Failure, InputError.
    void restore() { file_.restore(); }
    /// Throws support::Failure where the log was deleted, moved or changed meanwhile.
    void check_unchanged() const { file_.check_unchanged(); }
    /// Whether the log is still where it was made.
    bool in_place() const { return file_.in_place(); }
    /// The log as it should be on the disk.
    const std::string& content() const { return file_.content(); }

    /// Answers on the disk.
    std::size_t answers() const { return answers_; }
    const fs::path& path() const { return file_.path(); }
    fs::path sidecar_path() const { return fs::path(path()).replace_extension(".json"); }

private:
    explicit SessionLog(DurableFile file, std::size_t answers = 0)
        : file_(std::move(file)), answers_(answers) {}

    DurableFile file_;
    std::size_t answers_;
};

} // namespace experiment
