// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "session_plan.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <support/error.h>
#include <support/file.h>
#include <support/json_depth.h>

#include "log/session_log.h"
#include "log/sidecar.h"

namespace experiment {
namespace {

using nlohmann::ordered_json;
using support::input_error;

constexpr const char* way_out = "; give --new-run to begin a run of its own";

ordered_json read_sidecar(const fs::path& file) {
    const std::string text = support::read_text(file);
    support::check_json_depth(text, file.string());
    ordered_json content = ordered_json::parse(text, nullptr, false);
    if (!content.is_object()) {
        throw input_error("{}: expected a JSON object, found something else or a truncated file{}",
                          file.string(), way_out);
    }
    return content;
}

/// The order that a sidecar planned; reference and test follow from the protocol.
Schedule read_order(const ordered_json& sidecar, const study::Protocol& protocol, const fs::path& file) {
    Schedule schedule;
    for (const ordered_json& entry : sidecar.at("Order")) {
        std::istringstream words(entry.is_string() ? entry.get<std::string>() : "");
        Trial trial;
        words >> trial.first >> trial.second >> trial.distance >> trial.azimuth_deg;
        if (!words || !words.eof()) {
            throw input_error("{}: Order: expected \"FIRST SECOND DISTANCE AZIMUTH_DEG\", found {}{}",
                              file.string(), support::one_line(entry.dump()).substr(0, 60), way_out);
        }
        trial.reference = protocol.session.reference;
        trial.test = trial.first == trial.reference ? trial.second : trial.first;
        schedule.push_back(std::move(trial));
    }
    return schedule;
}

/// A value for a message: of digests and other long texts the beginning.
std::string shortened(const ordered_json& value) {
    constexpr std::size_t shown = 12;
    const std::string text = support::one_line(value.is_string() ? value.get<std::string>() : value.dump());
    return text.size() > shown ? text.substr(0, shown) + "..." : text;
}

/// Refuse to go on with a run under other conditions than it began with.
void check_same(const ordered_json& sidecar, const fs::path& file, const char* key, const ordered_json& now,
                std::string_view what) {
    const ordered_json before = sidecar.value(key, ordered_json());
    if (before != now) {
        throw input_error("{}: {}: expected {} that the run began with, {}, found {}{}", file.string(), key,
                          what, shortened(before), shortened(now), way_out);
    }
}

/// Refuse a sidecar whose parts are not what the session goes on with.
void check_kinds(const ordered_json& sidecar, const fs::path& file) {
    const auto check = [&](const ordered_json& holder, const char* key, auto is_right, const char* expected) {
        const ordered_json value = holder.value(key, ordered_json());
        if (!is_right(value)) {
            throw input_error("{}: {}: expected {}, found {}{}", file.string(), key, expected,
                              support::one_line(value.dump()).substr(0, 60), way_out);
        }
    };
    const auto array = [](const ordered_json& value) { return value.is_array(); };
    const auto whole = [](const ordered_json& value) { return value.is_number_unsigned(); };
    for (const char* key : {"Events", "SetAside", "Warnings", "Parts"}) {
        check(sidecar, key, array, "a list");
    }
    check(sidecar, "Seed", whole, "a whole number");
    check(sidecar, "TrialsPlanned", whole, "a whole number");
    check(
        sidecar, "Simulated", [](const ordered_json& value) { return value.is_boolean(); }, "true or false");
    for (const ordered_json& part : sidecar["Parts"]) {
        if (!part.is_object()) {
            throw input_error("{}: Parts: expected objects, found {}{}", file.string(),
                              support::one_line(part.dump()).substr(0, 60), way_out);
        }
        check(
            part, "SystemTime", [](const ordered_json& value) { return value.is_number(); }, "a number");
    }
}

/// By how much the system's clock lies before what the run has seen of it; 0 where it does not. A simulated
/// session's own clock runs ahead of the system's.
double clock_set_back_s(const ordered_json& sidecar, const LogContent& log) {
    const ordered_json& parts = sidecar["Parts"];
    if (parts.empty()) {
        return 0;
    }
    double latest_s = parts.back()["SystemTime"].get<double>();
    if (!sidecar["Simulated"].get<bool>()) {
        latest_s = std::max(latest_s, parts.front()["SystemTime"].get<double>() + log.last_s);
    }
    return std::max(0.0, latest_s - system_clock_s());
}

/// Take over an interrupted run.
void resume(SessionPlan& plan, const SessionOptions& options, const study::Protocol& protocol,
            const RunIdentity& identity, const fs::path& sidecar, const fs::path& log) {
    check_same(plan.sidecar, sidecar, "ProtocolDigest", protocol.digest, "the protocol");
    check_same(plan.sidecar, sidecar, "StimuliManifestDigest", identity.manifest_digest, "the stimuli");
    if (plan.sidecar.contains("ObserverDigest") || identity.observer_digest != "n/a") {
        check_same(plan.sidecar, sidecar, "ObserverDigest", identity.observer_digest, "the observer");
    }
    if (options.seed) {
        check_same(plan.sidecar, sidecar, "Seed", *options.seed, "the seed");
    }
    check_kinds(plan.sidecar, sidecar);
    plan.seed = plan.sidecar["Seed"].get<std::uint64_t>();
    plan.clock_set_back_s = clock_set_back_s(plan.sidecar, *plan.log);
    check_order(*plan.log, plan.schedule, log);
    plan.remarks.push_back(
        plan.answered() == plan.schedule.size()
            ? fmt::format("run {:02d} was broken off after its last answer; only its end is missing",
                          plan.run)
            : fmt::format("run {:02d} was broken off; it goes on at trial {} of {}", plan.run,
                          plan.answered() + 1, plan.schedule.size()));
    // Less may come of clocks that are kept exact.
    constexpr double noticed_s = 1;
    if (plan.clock_set_back_s > noticed_s) {
        plan.remarks.push_back(fmt::format(
            "the system's clock was set back by {:.0f} s or more since the run was broken off; onsets go on "
            "from the last answer",
            plan.clock_set_back_s));
    } else {
        plan.clock_set_back_s = 0;
    }
    if (!plan.log->torn.empty()) {
        plan.remarks.push_back(fmt::format("{}: its last line was torn and is set aside, in the sidecar: {}",
                                           log.string(), support::one_line(plan.log->torn)));
    }
}

/// Look at the participant's last run; whether the session goes on with it.
bool take_last_run(SessionPlan& plan, const SessionOptions& options, const study::Protocol& protocol,
                   const RunIdentity& identity) {
    plan.run = last_run(options.study, options.participant);
    const fs::path log = log_path(options.study, options.participant, plan.run);
    const fs::path sidecar = fs::path(log).replace_extension(".json");
    if (plan.run == 0 || options.new_run || !fs::exists(log)) {
        return false;
    }
    const ordered_json content = fs::exists(sidecar) ? read_sidecar(sidecar) : ordered_json();
    if (content.is_null() && support::read_text(log) == fmt::format("{}\n", log_header)) {
        // It was broken off before its sidecar was written, and nothing was shown.
        plan.log = read_log(log);
        return false;
    }
    if (content.is_null() || !content.contains("Order") || !content["Order"].is_array()) {
        plan.remarks.push_back(
            fmt::format("{}: has no order of trials in its sidecar and is left as it is", log.string()));
        return false;
    }
    plan.schedule = read_order(content, protocol, sidecar);
    try {
        plan.log = read_log(log);
        // A run that was killed between its last answer and its end is ended.
        if (plan.answered() < plan.schedule.size() || content.value("Complete", ordered_json()) == false) {
            plan.sidecar = content;
            resume(plan, options, protocol, identity, sidecar, log);
            return true;
        }
    } catch (const support::InputError& error) {
        const std::string reason = error.what();
        throw support::InputError(reason.ends_with(way_out) ? reason : reason + way_out);
    }
    plan.log.reset();
    plan.remarks.push_back(fmt::format("run {:02d} of this participant is complete; this will be run {:02d}",
                                       plan.run, plan.run + 1));
    return false;
}

/// The trials of a participant's last complete run; none where there is none.
Schedule finished_run(const fs::path& study, const std::string& label, const study::Protocol& protocol) {
    for (int run = last_run(study, label); run > 0; --run) {
        const fs::path log = log_path(study, label, run);
        const fs::path sidecar = fs::path(log).replace_extension(".json");
        if (fs::exists(log) && fs::exists(sidecar)) {
            const LogContent content = read_log(log);
            const ordered_json planned = read_sidecar(sidecar).value("TrialsPlanned", ordered_json());
            if (planned.is_number_unsigned() && content.trials.size() >= planned.get<std::size_t>() &&
                !content.trials.empty() && content.trials[0].reference == protocol.session.reference) {
                return content.trials;
            }
        }
    }
    return {};
}

/// Remark on runs of the study under another version of the protocol, which an analysis would not mix.
void note_other_versions(const fs::path& study, const study::Protocol& protocol, SessionPlan& plan) {
    int others = 0;
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(study, none)) {
        if (!entry.path().filename().string().ends_with("_beh.json")) {
            continue;
        }
        const auto content = nlohmann::json::parse(std::ifstream(entry.path()), nullptr, false);
        const auto digest =
            content.is_object() ? content.value("ProtocolDigest", nlohmann::json()) : nlohmann::json();
        others += digest.is_string() && digest != protocol.digest ? 1 : 0;
    }
    if (others > 0) {
        plan.remarks.push_back(
            fmt::format("runs of this study under another version of the protocol: {}; the "
                        "analysis refuses to mix them unless it is told to",
                        others));
    }
}

std::vector<Schedule> finished_by_others(const SessionOptions& options, const study::Protocol& protocol,
                                         std::vector<std::string>& remarks) {
    std::vector<Schedule> finished;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(options.study, none)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("sub-") || name == "sub-" + options.participant) {
            continue;
        }
        try {
            Schedule run = finished_run(options.study, name.substr(4), protocol);
            if (!run.empty()) {
                finished.push_back(std::move(run));
            }
        } catch (const std::runtime_error& error) {
            remarks.push_back(fmt::format("{}: its orders are not counted: {}", name, error.what()));
        }
    }
    return finished;
}

} // namespace

SessionPlan make_plan(const SessionOptions& options, const study::Protocol& protocol,
                      const RunIdentity& identity) {
    SessionPlan plan;
    note_other_versions(options.study, protocol, plan);
    if (take_last_run(plan, options, protocol, identity)) {
        return plan;
    }
    plan.run += plan.log ? 0 : 1;
    plan.seed = options.seed.value_or(default_seed(protocol, options.participant));
    plan.schedule = make_schedule(protocol, plan.seed);
    if (!options.seed) {
        const auto finished = finished_by_others(options, protocol, plan.remarks);
        plan.finished_participants = finished.size();
        plan.schedule = balanced(std::move(plan.schedule), finished);
    }
    return plan;
}

} // namespace experiment
