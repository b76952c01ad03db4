// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "session_log.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include <support/file.h>

namespace experiment {
namespace {

std::string run_prefix(const std::string& label) { return fmt::format("sub-{}_task-skin2afc_run-", label); }

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

fs::path log_path(const fs::path& study, const std::string& label, int run) {
    return study / ("sub-" + label) / "beh" / fmt::format("{}{:02d}_beh.tsv", run_prefix(label), run);
}

int last_run(const fs::path& study, const std::string& label) {
    int last = 0;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(study / ("sub-" + label) / "beh", none)) {
        last = std::max(last, run_of(entry.path().filename().string(), run_prefix(label)));
    }
    return last;
}

SessionLog SessionLog::create(const fs::path& study, const std::string& label) {
    const fs::path participant = study / ("sub-" + label);
    const fs::path folder = participant / "beh";
    support::make_writable_folder(folder);
    sync_folder(participant);
    sync_folder(study);

    // Take the first number after the last run that no other program takes before.
    for (int run = last_run(study, label) + 1;; ++run) {
        if (auto file = DurableFile::create(log_path(study, label, run), fmt::format("{}\n", log_header))) {
            return SessionLog(std::move(*file));
        }
    }
}

SessionLog SessionLog::resume(const fs::path& path, const LogContent& content) {
    return SessionLog(DurableFile::reopen(path, content.whole), content.trials.size());
}

void SessionLog::settle() {
    file_.settle();
    if (!file_.content().ends_with('\n')) {
        file_.append("\n");
    }
}

void SessionLog::append(const Answer& answer) {
    settle();
    file_.append(log_row(answers_ + 1, answer));
    ++answers_;
}

} // namespace experiment
