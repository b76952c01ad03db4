// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "session.h"

#include <memory>

#include <fmt/format.h>

#include <study/protocol.h>
#include <support/error.h>

#include "interruption.h"
#include "log/folder_lock.h"
#include "log/frame_table.h"
#include "log/phenotype.h"
#include "log/session_log.h"
#include "log/sidecar.h"
#include "log/study_folder.h"
#include "procedure.h"
#include "questionnaire.h"
#include "session_plan.h"
#include "simulated_stage.h"
#include "start_page.h"
#include "stimulus_set.h"
#include "window/window_stage.h"

namespace experiment {
namespace {

/// Everything that is known before anything is shown.
struct Preparation {
    study::Protocol protocol;
    std::optional<Observer> observer;
    StimulusSet stimuli;
    StudyFolder study;
    std::optional<FolderLock> lock; ///< on the participant, where something is to be written
    SessionPlan plan;
};

/// Lock the participant's folder, so that no second session writes there.
FolderLock lock_participant(const SessionOptions& options) {
    const fs::path folder = options.study / ("sub-" + options.participant);
    auto lock = FolderLock::attempt(folder);
    if (!lock) {
        throw support::input_error(
            "{}: expected a participant without a session, found another session at it", folder.string());
    }
    return std::move(*lock);
}

Preparation prepare(const SessionOptions& options) {
    check_label(options.participant);
    study::Protocol protocol = study::read_protocol(options.protocol);
    auto observer = options.observer ? std::optional(Observer(*options.observer, protocol)) : std::nullopt;
    StimulusSet stimuli(options.stimuli, stimuli_of(make_schedule(protocol, 0)), protocol.image.width,
                        protocol.image.height);
    StudyFolder study(options.study, observer.has_value(), protocol.name);
    std::optional<FolderLock> lock;
    if (!options.dry_run && !options.print_order) {
        lock.emplace(lock_participant(options));
    }
    SessionPlan plan = make_plan(options, protocol, stimuli.manifest_digest());
    if (stimuli.protocol_digest() != protocol.digest) {
        plan.remarks.push_back(fmt::format("{}: rendered by another version of the protocol than {}",
                                           (options.stimuli / "manifest.json").string(),
                                           options.protocol.string()));
    }
    if (options.frames && fs::exists(*options.frames)) {
        throw support::input_error("--frames: {}: expected a name that is free, found a file",
                                   options.frames->string());
    }
    return {std::move(protocol), std::move(observer), std::move(stimuli),
            std::move(study),    std::move(lock),     std::move(plan)};
}

/// Write something, and say so on the stage and try again where that fails.
template <typename Write>
void write_with_retries(Stage& stage, Write write) {
    while (true) {
        try {
            return write();
        } catch (const std::runtime_error& error) {
            if (!stage.tell_trouble(error.what())) {
                throw;
            }
        }
    }
}

/// The log of the plan's run, created or gone on with.
SessionLog open_log(const SessionOptions& options, const SessionPlan& plan) {
    if (!plan.log) {
        return SessionLog::create(options.study, options.participant);
    }
    return SessionLog::resume(log_path(options.study, options.participant, plan.run), plan.answered(),
                              plan.log->whole);
}

/// Run the trials and record in the sidecar how they ended.
void run_to_the_end(const Preparation& ready, Stage& stage, SessionLog& log, Sidecar& sidecar) {
    const study::SessionSettings& session = ready.protocol.session;
    const Schedule& schedule = ready.plan.schedule;
    const auto explain = [&](const std::string& reason) {
        return fmt::format("{}; {} of {} trials are saved in {}", reason, log.answers(), schedule.size(),
                           log.path().string());
    };
    Timing timing;
    const Setting setting{
        .session = session,
        .schedule = schedule,
        .practice = practice_trials(schedule, static_cast<std::size_t>(session.practice), ready.plan.seed),
        .clock_start_s = sidecar.clock_start_s(ready.plan.log ? ready.plan.log->last_s : 0),
        .note = [&](const std::vector<Event>& events) { sidecar.note(events); },
        .timing = &timing};
    try {
        run_trials(setting, stage, log);
        write_with_retries(
            stage, [&] { sidecar.finish(log.answers(), "all trials answered", stage.facts(), timing); });
    } catch (const Interrupted& interruption) {
        sidecar.finish(log.answers(), interruption.what(), stage.facts(), timing);
        throw support::Failure(explain(interruption.what()));
    } catch (const std::exception& error) {
        // The sidecar as it is says "not complete", should the disk refuse it too.
        try {
            sidecar.finish(log.answers(), support::one_line(error.what()), stage.facts(), timing);
        } catch (const std::runtime_error&) {
            throw support::Failure(explain(error.what()));
        }
        throw support::Failure(explain(error.what()));
    }
    try {
        run_end_page(session, schedule, stage);
    } catch (const Interrupted&) {
        return; // leaving at the last page loses nothing
    }
}

/// Ask the participant what comes before the trials; what to write of it. Throws support::Failure where there
/// is no consent.
Answers run_forms(const SessionOptions& options, const Preparation& ready, Stage& stage) {
    const study::SessionSettings& session = ready.protocol.session;
    if (!ready.plan.resumes() && !ask_consent(session.texts, stage)) {
        stage.show(Page{session.texts.declined});
        stage.wait_for({Key::space});
        throw support::failure("the participant did not agree to take part; nothing was written");
    }
    return session.questions.empty() || has_answered(options.study, options.participant)
               ? Answers{}
               : ask_questions(session, stage);
}

void run_on(const SessionOptions& options, const Preparation& ready, Stage& stage) {
    const study::Protocol& protocol = ready.protocol;
    Answers answers;
    try {
        if (!ready.observer) {
            stage.ask(start_page(options, protocol, ready.stimuli, ready.plan, stage.facts()));
        }
        answers = run_forms(options, ready, stage);
    } catch (const Interrupted& reason) {
        throw support::failure("{} before the first trial; nothing was written", reason.what());
    }

    // Open the files before the first picture, and run.
    write_with_retries(stage, [&] {
        ready.study.prepare(protocol.title, options.participant);
        ready.study.keep_contact_sheet(ready.stimuli.folder() / "contact_sheet.png");
        if (!answers.empty()) {
            save_answers(options.study, options.participant, protocol.session.questions, answers);
        }
    });
    std::optional<SessionLog> log;
    write_with_retries(stage, [&] { log.emplace(open_log(options, ready.plan)); });
    Sidecar sidecar(log->sidecar_path(), protocol, ready.plan, ready.stimuli.manifest_digest(),
                    stage.facts());
    if (!ready.plan.resumes() && !protocol.session.texts.consent.empty()) {
        sidecar.note_consent();
    }
    write_with_retries(stage, [&] { sidecar.write(); });
    run_to_the_end(ready, stage, *log, sidecar);
    fmt::print("{}: {} of {} trials\n", log->path().string(), log->answers(), ready.plan.schedule.size());
}

} // namespace

void run_session(const SessionOptions& options) {
    // Check everything before anything is shown or written.
    const Preparation ready = prepare(options);
    if (options.print_order) {
        return print_order(ready.plan.schedule);
    }
    for (const std::string& remark : ready.plan.remarks) {
        fmt::print(stderr, "skin2afc: note: {}\n", support::one_line(remark));
    }
    if (options.dry_run) {
        return print_dry_run(options, ready.protocol, ready.stimuli, ready.plan);
    }

    // Set the stage.
    const Interruption interruption;
    std::unique_ptr<Stage> stage;
    try {
        if (ready.observer) {
            stage = std::make_unique<SimulatedStage>(*ready.observer, ready.plan.seed);
        } else {
            stage = std::make_unique<WindowStage>(ready.protocol, ready.plan.schedule.size(), ready.stimuli,
                                                  options.screen);
        }
    } catch (const Interrupted& reason) {
        throw support::failure("{} before the first trial; nothing was written", reason.what());
    }
    const FrameTable frames(options.frames, *stage);
    run_on(options, ready, *stage);
}

} // namespace experiment
