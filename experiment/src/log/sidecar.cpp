// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "sidecar.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <support/error.h>
#include <support/file.h>

#include "../window/pacing.h"

namespace experiment {
namespace {

using nlohmann::ordered_json;

constexpr const char* still_running = "running, or ended without notice";

std::string operating_system() {
    struct utsname name {};
    return ::uname(&name) == 0 ? fmt::format("{} {} {}", name.sysname, name.release, name.machine) : "n/a";
}

/// A value, or "n/a".
template <typename T>
ordered_json or_na(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json("n/a");
}

ordered_json presentation(const StageFacts& stage) {
    ordered_json facts{{"OperatingSystem", operating_system()},
                       {"SoftwareName", "skin2afc"},
                       {"SoftwareVersion", SKIN2AFC_VERSION}};
    if (stage.screen_size_mm) {
        facts["ScreenSize"] = {(*stage.screen_size_mm)[0] / 1000, (*stage.screen_size_mm)[1] / 1000};
    }
    if (stage.viewing_distance_mm) {
        facts["ScreenDistance"] = *stage.viewing_distance_mm / 1000;
    }
    if (stage.resolution_px) {
        facts["ScreenResolution"] = *stage.resolution_px;
    }
    if (stage.refresh_hz) {
        facts["ScreenRefreshRate"] = *stage.refresh_hz;
    }
    return facts;
}

/// What may differ between the parts of a run.
ordered_json screen_of(const StageFacts& stage) {
    return {{"StimulusPresentation", presentation(stage)},      {"Monitor", stage.monitor},
            {"StimulusWidth", or_na(stage.stimulus_width_deg)}, {"Pacing", stage.pacing},
            {"RefreshRate", or_na(stage.refresh_hz)},           {"GLRenderer", stage.gl_renderer}};
}

ordered_json column(const char* description) { return {{"Description", description}}; }

ordered_json seconds(const char* description) { return {{"Description", description}, {"Units", "s"}}; }

ordered_json levels(const char* description,
                    std::initializer_list<std::pair<const char*, const char*>> values) {
    ordered_json entry = column(description);
    for (const auto& [value, meaning] : values) {
        entry["Levels"][value] = meaning;
    }
    return entry;
}

/// Describe the log's columns, in their order.
ordered_json columns() {
    ordered_json all;
    all["trial"] = column("Number of the trial in the order shown, from 1");
    all["reference"] = column("Shader that the others are compared with");
    all["test"] = column("Shader compared with the reference");
    all["distance"] = column("Name of the camera distance");
    all["azimuth_deg"] = {{"Description", "Azimuth of the light, 0 in front of the face, about the vertical"},
                          {"Units", "degree"}};
    all["first"] = column("Shader shown first");
    all["second"] = column("Shader shown second");
    all["response"] = levels("Key pressed: which picture was chosen",
                             {{"1", "the first picture"}, {"2", "the second picture"}});
    all["chosen"] = column("Shader chosen");
    all["response_time"] = seconds("From the onset of the second picture to the key press");
    all["onset_first"] =
        seconds("Onset of the first picture since the session's start, the instructions' onset");
    all["onset_grey"] = seconds("Onset of the grey between the pictures since the session's start");
    all["onset_second"] = seconds("Onset of the second picture since the session's start");
    return all;
}

/// The order of the trials in words, which a resumed session reads.
ordered_json order_of(const Schedule& schedule) {
    ordered_json order = ordered_json::array();
    for (const Trial& trial : schedule) {
        order.push_back(text_of(trial));
    }
    return order;
}

/// Median and worst of times, "n/a" where there are none.
void add_spread(ordered_json& to, const std::string& name, std::vector<double> values_s) {
    if (values_s.empty()) {
        to[name + "Median"] = to[name + "Worst"] = "n/a";
        return;
    }
    std::transform(values_s.begin(), values_s.end(), values_s.begin(), [](double s) { return std::abs(s); });
    to[name + "Median"] = median(values_s);
    to[name + "Worst"] = *std::max_element(values_s.begin(), values_s.end());
}

/// What a participant may see the difference of.
ordered_json flat_screen(const ordered_json& screen) {
    ordered_json flat = ordered_json::object();
    for (const char* key : {"Monitor", "StimulusWidth", "Pacing", "RefreshRate", "GLRenderer"}) {
        flat[key] = screen.value(key, ordered_json("n/a"));
    }
    const ordered_json shown = screen.value("StimulusPresentation", ordered_json::object());
    for (const char* key : {"ScreenSize", "ScreenDistance", "ScreenResolution"}) {
        flat[key] = shown.is_object() ? shown.value(key, ordered_json("n/a")) : ordered_json("n/a");
    }
    return flat;
}

/// A line for each answered trial: how its grey, its saving and its frames went.
ordered_json trials_of(std::size_t first, const StageFacts& facts, const std::vector<Flip>& flips,
                       const Timing& timing) {
    ordered_json trials = ordered_json::array();
    for (std::size_t i = 0; i < timing.grey_error_s.size(); ++i) {
        int pictures = 0, frames = 0, dropped = 0;
        for (const Flip& flip : flips) {
            if (flip.trial == first + i) {
                pictures += flip.frame == 1 ? 1 : 0;
                ++frames;
                dropped += flip.missed_frames;
            }
        }
        trials.push_back({{"Trial", first + i},
                          {"GreyError", timing.grey_error_s[i]},
                          {"SaveTime", timing.save_s[i]},
                          {"Pictures", pictures},
                          {"Frames", frames},
                          {"DroppedFrames", facts.dropped_frames ? ordered_json(dropped) : "n/a"}});
    }
    return trials;
}

} // namespace

double system_clock_s() {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string Sidecar::time_text(double time_s) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(time_s)));
}

Sidecar::Sidecar(fs::path path, const study::Protocol& protocol, const SessionPlan& plan,
                 const std::string& manifest_digest, const StageFacts& stage)
    : path_(std::move(path)), content_(plan.sidecar), now_s_(system_clock_s()) {
    if (!plan.resumes()) {
        content_ = {
            {"TaskName", "skin2afc"},
            {"TaskDescription",
             "Two-alternative forced choice between two pictures of rendered skin, shown one after the "
             "other; the instructions say what was asked"},
            {"Instructions", fill_in(protocol.session.texts.instructions, 0, plan.schedule.size())},
            {"Protocol", protocol.name},
            {"ProtocolDigest", protocol.digest},
            {"StimuliManifestDigest", manifest_digest},
            {"Seed", plan.seed},
            {"TrialsPlanned", plan.schedule.size()},
            {"GreyDuration", protocol.session.grey_s},
            {"Simulated", stage.observer.has_value()},
            {"Observer", or_na(stage.observer)},
            {"ObserverDigest", or_na(stage.observer_digest)}};
    }
    if (!plan.resumes()) {
        content_.update(screen_of(stage));
    }
    for (const char* key : {"ResponseTimeResolution", "WorstKeyDelay", "DroppedFrames"}) {
        content_[key] = content_.value(key, ordered_json("n/a"));
    }
    content_["TrialsAnswered"] = plan.answered();
    content_["Complete"] = false;
    content_["Ending"] = still_running;
    if (!plan.resumes()) {
        content_["Consent"] = "n/a";
        content_["FinishedParticipants"] = plan.finished_participants;
        content_["Order"] = order_of(plan.schedule);
        content_["Parts"] = ordered_json::array();
        content_["Events"] = ordered_json::array();
        content_["SetAside"] = ordered_json::array();
        content_["Warnings"] = ordered_json::array();
        content_.update(columns());
    }
    ordered_json& warnings = content_["Warnings"];
    for (const std::string& warning : stage.warnings) {
        if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
            warnings.push_back(warning);
        }
    }
    begin_part(plan, stage);
}

/// Note that the session begins or goes on.
void Sidecar::begin_part(const SessionPlan& plan, const StageFacts& stage) {
    const double clock_s = clock_start_s(plan.log ? plan.log->last_s : 0);
    ordered_json& parts = content_["Parts"];
    if (plan.clock_set_back_s > 0) {
        content_["Events"].push_back(
            {{"Time", clock_s},
             {"Trial", plan.answered() + 1},
             {"Event",
              "the system's clock was set back since the run was broken off; onsets go on from the last "
              "answer"}});
    }
    // A line that a part before this one set aside, but could not take off the log, is there already.
    ordered_json& aside = content_["SetAside"];
    if (plan.log && !plan.log->torn.empty() && (aside.empty() || aside.back() != plan.log->torn)) {
        aside.push_back(plan.log->torn);
    }
    parts.push_back({{"FirstTrial", plan.answered() + 1},
                     {"StartTime", time_text(now_s_)},
                     {"SystemTime", now_s_},
                     {"ClockStart", clock_s},
                     {"Ending", still_running}});
    parts.back().update(screen_of(stage));
}

double Sidecar::clock_start_s(double last_s) const {
    const ordered_json parts = content_.value("Parts", ordered_json::array());
    if (parts.empty() || content_.value("Simulated", false)) {
        return last_s;
    }
    const ordered_json& first = parts.front();
    return std::max(last_s, now_s_ - first.value("SystemTime", now_s_));
}

void Sidecar::write() const {
    support::make_writable_folder(path_.parent_path());
    support::write_atomically(path_,
                              content_.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

void Sidecar::note(const std::vector<Event>& events) {
    for (const Event& event : events) {
        content_["Events"].push_back(
            {{"Time", event.time_s}, {"Trial", event.trial}, {"Event", support::one_line(event.what)}});
    }
}

void Sidecar::finish(std::size_t answers, const std::string& ending, const Stage& stage,
                     const Timing& timing) {
    const StageFacts facts = stage.facts();
    content_["TrialsAnswered"] = answers;
    content_["Complete"] = answers == content_["TrialsPlanned"].get<std::size_t>();
    content_["Ending"] = ending;
    ordered_json& part = content_["Parts"].back();
    part["Ending"] = ending;
    part["ResponseTimeResolution"] = or_na(facts.key_resolution_s);
    part["WorstKeyDelay"] = or_na(facts.worst_key_delay_s);
    part["DroppedFrames"] = or_na(facts.dropped_frames);
    add_spread(part, "GreyError", timing.grey_error_s);
    add_spread(part, "SaveTime", timing.save_s);
    part["Trials"] = trials_of(part["FirstTrial"].get<std::size_t>(), facts, stage.flips(), timing);

    // The run's are the worst of its parts, and all frames that were dropped.
    for (const ordered_json& each : content_["Parts"]) {
        for (const char* key : {"ResponseTimeResolution", "WorstKeyDelay"}) {
            const ordered_json value = each.value(key, ordered_json());
            ordered_json& worst = content_[key];
            if (value.is_number() && (!worst.is_number() || worst < value)) {
                worst = value;
            }
        }
    }
    int dropped = 0;
    for (const ordered_json& each : content_["Parts"]) {
        const ordered_json frames = each.value("DroppedFrames", ordered_json());
        if (frames.is_number_integer()) {
            dropped += frames.get<int>();
            content_["DroppedFrames"] = dropped;
        }
    }
}

std::vector<std::string> screen_changes(const ordered_json& sidecar, const StageFacts& stage) {
    std::vector<std::string> changes;
    if (!sidecar.is_object() || sidecar.value("Parts", ordered_json::array()).empty()) {
        return changes;
    }
    // A refresh rate is measured anew each time.
    constexpr double tolerance = 0.01;
    const auto differ = [](const ordered_json& a, const ordered_json& b) {
        return a.is_number() && b.is_number()
                   ? std::abs(a.get<double>() - b.get<double>()) > tolerance * std::abs(a.get<double>())
                   : a != b;
    };
    const ordered_json before = flat_screen(sidecar["Parts"].back());
    const ordered_json after = flat_screen(screen_of(stage));
    for (const auto& [key, now] : after.items()) {
        const auto old = before.find(key);
        if (now != "n/a" && old != before.end() && differ(*old, now)) {
            changes.push_back(fmt::format("{} is {}, and was {} when the run was broken off", key, now.dump(),
                                          support::one_line(old->dump()).substr(0, 80)));
        }
    }
    return changes;
}

} // namespace experiment
