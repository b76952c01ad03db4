// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "session_log.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include <support/file.h>

namespace experiment {
namespace {

/// The run number in a log's or sidecar's name; 0 for other names.
int run_of(const std::string& name, const std::string& prefix) {
    int run = 0;
    if (name.starts_with(prefix)) {
        std::from_chars(name.data() + prefix.size(), name.data() + name.size(), run);
    }
    return std::max(run, 0);
}

} // namespace

const std::string_view log_header = "trial\treference\ttest\tdistance\tazimuth_deg\tfirst\tsecond\tresponse\t"
                                    "chosen\tresponse_time\tonset_first\tonset_grey\tonset_second";

std::string log_row(std::size_t number, const Answer& answer) {
    const Trial& trial = answer.trial;
    return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\n", number,
                       trial.reference, trial.test, trial.distance, trial.azimuth_deg, trial.first,
                       trial.second, answer.response, answer.response == 1 ? trial.first : trial.second,
                       answer.response_time_s, answer.onset_first_s, answer.onset_grey_s,
                       answer.onset_second_s);
}

SessionLog SessionLog::create(const fs::path& study, const std::string& label) {
    const fs::path participant = study / ("sub-" + label);
    const fs::path folder = participant / "beh";
    support::make_writable_folder(folder);
    sync_folder(participant);
    sync_folder(study);

    // Go on after the last run that has left a file.
    const std::string prefix = fmt::format("sub-{}_task-skin2afc_run-", label);
    int run = 1;
    for (const auto& entry : fs::directory_iterator(folder)) {
        run = std::max(run, run_of(entry.path().filename().string(), prefix) + 1);
    }
    // Take the first number that no other program takes before.
    for (;; ++run) {
        const fs::path path = folder / fmt::format("{}{:02d}_beh.tsv", prefix, run);
        if (auto file = DurableFile::create(path, fmt::format("{}\n", log_header))) {
            return SessionLog(std::move(*file));
        }
    }
}

void SessionLog::append(const Answer& answer) {
    file_.append(log_row(answers_ + 1, answer));
    ++answers_;
}

} // namespace experiment
