// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/study.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <support/error.h>
#include <support/file.h>

namespace stats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view task = "_task-skin2afc", run_entity = "_run-", log_suffix = "_beh.tsv";
constexpr std::uintmax_t largest_json = std::uintmax_t{16} << 20;

/// A JSON file's object; an empty one where there is no file.
json read_object(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) {
        return json::object();
    }
    json object;
    try {
        object = json::parse(support::read_text(file, largest_json));
    } catch (const json::exception& error) {
        // Leave out the library's "[json.exception...] " in front of the message.
        const std::string_view message = error.what();
        throw support::input_error("{}: expected JSON, found: {}", file.string(),
                                   message.substr(message.find("] ") + 2));
    }
    if (!object.is_object()) {
        throw support::input_error("{}: expected a JSON object, found {}", file.string(), object.type_name());
    }
    return object;
}

/// A field's value where the object has it; throws InputError when it is of another type.
template <typename T>
std::optional<T> field(const json& object, const fs::path& file, const char* key, std::string_view expected,
                       bool (json::*is_expected)() const noexcept) {
    const auto found = object.find(key);
    if (found == object.end()) {
        return std::nullopt;
    }
    if (!((*found).*is_expected)()) {
        // An array or object may be too deep to be shown.
        throw support::input_error("{}: {}: expected {}, found {}", file.string(), key, expected,
                                   found->is_structured() ? std::string(found->type_name())
                                                          : found->dump().substr(0, 60));
    }
    return found->get<T>();
}

bool simulated_in(const json& object, const fs::path& file) {
    return field<bool>(object, file, "Simulated", "true or false", &json::is_boolean).value_or(false);
}

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
    const fs::path sidecar = fs::path(file).replace_extension(".json");
    const json object = read_object(sidecar);
    run.simulated = simulated_in(object, sidecar);
    run.trials_planned = field<std::int64_t>(object, sidecar, "TrialsPlanned", "a whole number from 1 on",
                                             &json::is_number_unsigned);
    if (run.trials_planned && *run.trials_planned < 1) {
        throw support::input_error("{}: TrialsPlanned: expected a whole number from 1 on, found {}",
                                   sidecar.string(), *run.trials_planned);
    }
    return run;
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
        run.trials_expected = run.trials_planned ? static_cast<std::size_t>(*run.trials_planned) : longest;
        run.complete = run.log.trials.size() >= run.trials_expected;
    }
    for (auto start = runs.begin(); start != runs.end();) {
        const auto end = std::find_if(start, runs.end(),
                                      [&](const Run& run) { return run.participant != start->participant; });
        choose_among(std::span<Run>(start, end));
        start = end;
    }
}

Study read_study(const fs::path& folder) {
    if (std::error_code ignored; !is_folder(folder)) {
        throw support::input_error("{}: expected a study's folder, found {}", folder.string(),
                                   fs::exists(folder, ignored) ? "a file" : "nothing");
    }
    Study study;
    const fs::path description = folder / "dataset_description.json";
    const json object = read_object(description);
    study.simulated = simulated_in(object, description);
    const auto folder_name =
        (fs::absolute(folder).lexically_normal() / ".").parent_path().filename().string();
    study.name =
        field<std::string>(object, description, "Name", "a text", &json::is_string).value_or(folder_name);

    for (const fs::path& subject : entries(folder)) {
        if (!subject.filename().string().starts_with("sub-") || !is_folder(subject)) {
            continue;
        }
        const std::string participant = participant_label(subject);
        const std::size_t before = study.runs.size();
        if (is_folder(subject / "beh")) {
            for (const fs::path& file : entries(subject / "beh")) {
                if (const auto number = run_number(file, participant)) {
                    study.runs.push_back(read_run(folder, file, participant, *number));
                }
            }
        }
        if (study.runs.size() == before) {
            study.participants_without_log.push_back(participant);
        }
    }
    std::stable_sort(study.runs.begin(), study.runs.end(), [](const Run& a, const Run& b) {
        return std::tie(a.participant, a.number) < std::tie(b.participant, b.number);
    });

    if (study.runs.empty()) {
        throw support::input_error(
            "{}: expected logs sub-<label>/beh/sub-<label>{}[_run-<number>]{}, found none", folder.string(),
            task, log_suffix);
    }
    choose_runs(study.runs);
    const Contents found = contents(study);
    if (found.trials == found.unanswered) {
        throw support::input_error("{}: expected at least one answer, found none in {} logs", folder.string(),
                                   study.runs.size());
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
        result.simulated_runs += run.simulated || study.simulated ? 1 : 0;
        result.trials += run.log.trials.size();
        result.unanswered +=
            static_cast<std::size_t>(std::count_if(run.log.trials.begin(), run.log.trials.end(),
                                                   [](const Trial& t) { return !t.reference_chosen; }));
    }
    return result;
}

bool is_simulated(const Study& study) { return study.simulated || contents(study).simulated_runs > 0; }

} // namespace stats
