// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "sidecar.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <support/file.h>

#include "../procedure.h"

namespace experiment {
namespace {

using nlohmann::ordered_json;

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
    if (stage.resolution_px) {
        facts["ScreenResolution"] = *stage.resolution_px;
    }
    if (stage.refresh_hz) {
        facts["ScreenRefreshRate"] = *stage.refresh_hz;
    }
    return facts;
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
    all["response"] = levels("Key pressed: which picture looked more like real skin",
                             {{"1", "the first picture"}, {"2", "the second picture"}});
    all["chosen"] = column("Shader chosen");
    all["response_time"] = seconds("From the onset of the second picture to the key press");
    all["onset_first"] =
        seconds("Onset of the first picture since the session's start, the instructions' onset");
    all["onset_grey"] = seconds("Onset of the grey between the pictures since the session's start");
    all["onset_second"] = seconds("Onset of the second picture since the session's start");
    return all;
}

} // namespace

Sidecar::Sidecar(fs::path path, const study::Protocol& protocol, const SessionFacts& session,
                 const StageFacts& stage)
    : path_(std::move(path)) {
    content_ = {{"TaskName", "skin2afc"},
                {"TaskDescription",
                 "Two-alternative forced choice: of two pictures of a face shown one after the "
                 "other, which looks most like real human skin"},
                {"Instructions", fill_in(protocol.session.texts.instructions, 0, session.trials_planned)},
                {"StimulusPresentation", presentation(stage)},
                {"Protocol", protocol.name},
                {"ProtocolDigest", protocol.digest},
                {"StimuliManifestDigest", session.stimuli_manifest_digest},
                {"Seed", session.seed},
                {"TrialsPlanned", session.trials_planned},
                {"GreyDuration", protocol.session.grey_s},
                {"Simulated", stage.observer.has_value()},
                {"Observer", or_na(stage.observer)},
                {"Pacing", stage.pacing},
                {"RefreshRate", or_na(stage.refresh_hz)},
                {"GLRenderer", stage.gl_renderer},
                {"ResponseTimeResolution", or_na(stage.key_resolution_s)},
                {"WorstKeyDelay", "n/a"},
                {"DroppedFrames", or_na(stage.dropped_frames)},
                {"TrialsAnswered", 0},
                {"Complete", false},
                {"Ending", "running, or ended without notice"}};
    content_.update(columns());
}

void Sidecar::write() const {
    support::write_atomically(path_,
                              content_.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

void Sidecar::finish(std::size_t answers, const std::string& ending, const StageFacts& stage) {
    content_["WorstKeyDelay"] = or_na(stage.worst_key_delay_s);
    content_["DroppedFrames"] = or_na(stage.dropped_frames);
    content_["TrialsAnswered"] = answers;
    content_["Complete"] = answers == content_["TrialsPlanned"].get<std::size_t>();
    content_["Ending"] = ending;
    write();
}

} // namespace experiment
