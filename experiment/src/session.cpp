// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "session.h"

#include <memory>

#include <fmt/format.h>

#include <study/protocol.h>
#include <support/error.h>

#include "interruption.h"
#include "log/session_log.h"
#include "log/sidecar.h"
#include "log/study_folder.h"
#include "procedure.h"
#include "schedule.h"
#include "simulated_stage.h"
#include "stimulus_set.h"
#include "window/window_stage.h"

namespace experiment {
namespace {

/// Run the trials and record in the sidecar how they ended.
void run_to_the_end(const study::Protocol& protocol, const Schedule& schedule, Stage& stage, SessionLog& log,
                    Sidecar& sidecar) {
    const auto explain = [&](const std::string& reason) {
        return fmt::format("{}; {} of {} trials are saved in {}", reason, log.answers(), schedule.size(),
                           log.path().string());
    };
    try {
        run_trials(protocol.session, schedule, stage, log);
        sidecar.finish(log.answers(), "all trials answered", stage.facts());
    } catch (const Interrupted& interruption) {
        sidecar.finish(log.answers(), interruption.what(), stage.facts());
        throw support::Failure(explain(interruption.what()));
    } catch (const std::exception& error) {
        // The sidecar as it is says "not complete", should the disk refuse it too.
        try {
            sidecar.finish(log.answers(), support::one_line(error.what()), stage.facts());
        } catch (const support::Failure&) {
            throw support::Failure(explain(error.what()));
        }
        throw support::Failure(explain(error.what()));
    }
    try {
        run_end_page(protocol.session, schedule, stage);
    } catch (const Interrupted&) {
        return; // leaving at the last page loses nothing
    }
}

} // namespace

void run_session(const SessionOptions& options) {
    // Check everything before anything is shown or written.
    check_label(options.participant);
    const study::Protocol protocol = study::read_protocol(options.protocol);
    const std::uint64_t seed = options.seed.value_or(default_seed(protocol, options.participant));
    const Schedule schedule = make_schedule(protocol, seed);
    const auto observer =
        options.observer ? std::optional(Observer(*options.observer, protocol)) : std::nullopt;
    const StimulusSet stimuli(options.stimuli, stimuli_of(schedule), protocol.image.width,
                              protocol.image.height);
    const StudyFolder study(options.study, observer.has_value(), protocol.name);
    if (stimuli.protocol_digest() != protocol.digest) {
        fmt::print(stderr, "skin2afc: warning: {}: rendered by another version of the protocol than {}\n",
                   (options.stimuli / "manifest.json").string(), options.protocol.string());
    }

    // Set the stage.
    const Interruption interruption;
    std::unique_ptr<Stage> stage;
    try {
        if (observer) {
            stage = std::make_unique<SimulatedStage>(*observer, seed);
        } else {
            stage = std::make_unique<WindowStage>(protocol, schedule, stimuli, options.windowed);
        }
    } catch (const Interrupted& reason) {
        throw support::failure("{} before the first trial; nothing was written", reason.what());
    }

    // Open the log before the first picture, and run.
    study.prepare(protocol.title, options.participant);
    study.keep_contact_sheet(stimuli.folder() / "contact_sheet.png");
    SessionLog log = SessionLog::create(options.study, options.participant);
    Sidecar sidecar(log.sidecar_path(), protocol, {seed, schedule.size(), stimuli.manifest_digest()},
                    stage->facts());
    sidecar.write();
    run_to_the_end(protocol, schedule, *stage, log, sidecar);
    fmt::print("{}: {} of {} trials\n", log.path().string(), log.answers(), schedule.size());
}

} // namespace experiment
