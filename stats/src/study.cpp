// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/study.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include <support/error.h>

#include "labels.h"
#include "sidecar.h"

namespace stats {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view task = "_task-skin2afc", run_entity = "_run-", log_suffix = "_beh.tsv";

/// The entries of a folder, by name; hidden ones are left out.
std::vector<fs::path> entries(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> result;
    for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
        if (!i->path().filename().string().starts_with('.')) {
            result.push_back(i->path());
        }
    }
    if (error) {
        throw support::input_error("{}: expected a folder that can be read, found: {}", folder.string(),
                                   error.message());
    }
    std::sort(result.begin(), result.end());
    return result;
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

/// The label of "sub-<label>".
std::string participant_label(const fs::path& folder) {
    const std::string label = folder.filename().string().substr(4);
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+';
    };
    if (label.empty() || !std::all_of(label.begin(), label.end(), plain)) {
        throw support::input_error("{}: expected sub-<label> with a label of letters, digits and +",
                                   folder.string());
    }
    return label;
}

/// The run's number in a log's name; nothing for a file that is no log of this task.
std::optional<std::int64_t> run_number(const fs::path& file, const std::string& participant) {
    const std::string name = file.filename().string();
    if (!name.ends_with(log_suffix) || name.find(task) == std::string::npos) {
        return std::nullopt;
    }
    const std::string start = fmt::format("sub-{}{}", participant, task);
    std::int64_t number = 1;
    if (name != start + std::string(log_suffix)) {
        const auto opening = start + std::string(run_entity);
        const char* const last = name.data() + name.size() - log_suffix.size();
        const bool opens = name.starts_with(opening) && name.size() > opening.size() + log_suffix.size();
        const auto [end, error] = opens ? std::from_chars(name.data() + opening.size(), last, number)
                                        : std::from_chars_result{nullptr, std::errc::invalid_argument};
        if (error != std::errc() || end != last || number < 0) {
            throw support::input_error("{}: expected the name {}[_run-<number>]{}", file.string(), start,
                                       log_suffix);
        }
    }
    return number;
}

Run read_run(const fs::path& study, const fs::path& file, std::string participant, std::int64_t number) {
    Run run;
    run.participant = std::move(participant);
    run.number = number;
    run.file = file.lexically_relative(study).string();
    run.log = read_log(file);
    run.sidecar = read_sidecar(fs::path(file).replace_extension(".json"));
    return run;
}

/// A bad file, or with what it was called to be read; the study goes on without it.
template <typename Read>
void try_to(Study& study, const fs::path& folder, const fs::path& file, Read read) {
    try {
        read();
    } catch (const support::InputError& error) {
        study.bad_files.push_back({file.lexically_relative(folder).string(), error.what()});
    }
}

/// Read the runs of one participant's folder.
void read_participant(Study& study, const fs::path& folder, const fs::path& subject) {
    const std::string participant = participant_label(subject);
    bool any = false;
    if (is_folder(subject / "beh")) {
        for (const fs::path& file : entries(subject / "beh")) {
            try_to(study, folder, file, [&] {
                if (const auto number = run_number(file, participant)) {
                    any = true;
                    study.runs.push_back(read_run(folder, file, participant, *number));
                }
            });
        }
    }
    if (!any) {
        study.participants_without_log.push_back(participant);
    }
}

/// Choose among one participant's runs.
void choose_among(std::span<Run> runs) {
    Run* chosen = nullptr;
    for (Run& run : runs) {
        const bool better = run.complete || (chosen == nullptr || !chosen->complete);
        if (!run.log.trials.empty() && better) {
            chosen = &run;
        }
    }
    for (Run& run : runs) {
        run.used = &run == chosen;
        if (run.used) {
            continue;
        }
        run.why_left_out = run.log.trials.empty() ? "no trials"
                           : run.complete
                               ? "complete, but a later complete run counts"
                               : fmt::format("incomplete, {} of {} trials; run {} counts",
                                             run.log.trials.size(), run.trials_expected, chosen->number);
    }
}

} // namespace

void choose_runs(std::vector<Run>& runs) {
    std::size_t longest = 1;
    for (const Run& run : runs) {
        longest = std::max(longest, run.log.trials.size());
    }
    for (Run& run : runs) {
        run.trials_expected =
            run.sidecar.trials_planned ? static_cast<std::size_t>(*run.sidecar.trials_planned) : longest;
        run.complete = run.log.trials.size() >= run.trials_expected;
    }
    for (auto start = runs.begin(); start != runs.end();) {
        const auto end = std::find_if(start, runs.end(),
                                      [&](const Run& run) { return run.participant != start->participant; });
        choose_among(std::span<Run>(start, end));
        start = end;
    }
}

namespace {

/// Choose the runs that count, and set those aside whose protocol is not that of most of them.
void check_protocols(Study& study, const fs::path& folder, bool mixed_allowed) {
    const auto key = [](const Run& run) {
        return std::pair(run.sidecar.protocol, run.sidecar.protocol_digest);
    };
    // Runs that would not count have a protocol, but no vote on which is the study's.
    choose_runs(study.runs);
    std::map<std::pair<std::string, std::string>, std::size_t> counts;
    for (const Run& run : study.runs) {
        if (!run.sidecar.protocol.empty() || !run.sidecar.protocol_digest.empty()) {
            counts[key(run)] += run.used ? 1 : 0;
        }
    }
    if (mixed_allowed || counts.size() < 2) {
        return;
    }
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto other = [&](const Run& run) {
        const auto found = counts.find(key(run));
        return found != counts.end() && found != most;
    };
    for (const Run& run : study.runs) {
        if (other(run)) {
            const auto sidecar = fs::path(run.file).replace_extension(".json");
            const auto& [name, digest] = most->first;
            const bool names = run.sidecar.protocol != name;
            study.bad_files.push_back(
                {run.file,
                 fmt::format("{}: {}: expected \"{}\" as in {}, found \"{}\" "
                             "(--mixed-protocols takes them together)",
                             (folder / sidecar).string(), names ? "Protocol" : "ProtocolDigest",
                             (names ? name : digest).substr(0, 64), counted(most->second, "run"),
                             (names ? run.sidecar.protocol : run.sidecar.protocol_digest).substr(0, 64))});
        }
    }
    std::erase_if(study.runs, other);
    choose_runs(study.runs);
}

} // namespace

Study read_study(const fs::path& folder, const Leniency& leniency) {
    if (std::error_code ignored; !is_folder(folder)) {
        throw support::input_error("{}: expected a study's folder, found {}", folder.string(),
                                   fs::exists(folder, ignored) ? "a file" : "nothing");
    }
    Study study;
    const Description description = read_description(folder / "dataset_description.json");
    study.simulated = description.simulated;
    study.name = description.name.value_or(
        (fs::absolute(folder).lexically_normal() / ".").parent_path().filename().string());

    for (const fs::path& subject : entries(folder)) {
        if (subject.filename().string().starts_with("sub-") && is_folder(subject)) {
            try_to(study, folder, subject, [&] { read_participant(study, folder, subject); });
        }
    }
    std::stable_sort(study.runs.begin(), study.runs.end(), [](const Run& a, const Run& b) {
        return std::tie(a.participant, a.number) < std::tie(b.participant, b.number);
    });
    for (std::size_t i = 1; i < study.runs.size(); ++i) {
        const Run &before = study.runs[i - 1], &run = study.runs[i];
        if (before.participant == run.participant && before.number == run.number) {
            study.bad_files.push_back(
                {run.file, fmt::format("{}: expected a run of its own, found run {} in {} too",
                                       (folder / run.file).string(), run.number, before.file)});
        }
    }
    std::erase_if(study.runs, [&](const Run& run) {
        return std::any_of(study.bad_files.begin(), study.bad_files.end(),
                           [&](const BadFile& bad) { return bad.file == run.file; });
    });
    check_protocols(study, folder, leniency.mixed_protocols);
    if (!leniency.skip_bad && !study.bad_files.empty()) {
        const std::size_t others = study.bad_files.size() - 1;
        throw support::input_error(
            "{}{}", study.bad_files.front().why,
            others == 0 ? ""
                        : fmt::format(" ({}; --skip-bad leaves them out)", counted(others, "more bad file")));
    }

    if (study.runs.empty()) {
        throw support::input_error(
            "{}: expected logs sub-<label>/beh/sub-<label>{}[_run-<number>]{}, found none{}", folder.string(),
            task, log_suffix, study.bad_files.empty() ? "" : " that can be read");
    }
    std::set<std::pair<std::string, std::string>> protocols;
    for (const Run& run : study.runs) {
        if (run.used && !(run.sidecar.protocol.empty() && run.sidecar.protocol_digest.empty())) {
            protocols.insert({run.sidecar.protocol, run.sidecar.protocol_digest});
        }
    }
    study.protocols = protocols.size();
    const Contents found = contents(study);
    if (found.trials == found.unanswered) {
        throw support::input_error("{}: expected at least one answer, found none in {}", folder.string(),
                                   counted(study.runs.size(), "log"));
    }
    return study;
}

Contents contents(const Study& study) {
    Contents result;
    for (const Run& run : study.runs) {
        if (!run.used) {
            continue;
        }
        ++result.participants;
        ++result.runs;
        result.simulated_runs += run.sidecar.simulated || study.simulated ? 1 : 0;
        result.trials += run.log.trials.size();
        result.unanswered +=
            static_cast<std::size_t>(std::count_if(run.log.trials.begin(), run.log.trials.end(),
                                                   [](const Trial& t) { return !t.reference_chosen; }));
    }
    return result;
}

bool is_simulated(const Study& study) { return study.simulated || contents(study).simulated_runs > 0; }

} // namespace stats
