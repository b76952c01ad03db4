// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "session.h"

#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <study/protocol.h>
#include <support/error.h>
#include <support/file.h>

#include "interruption.h"
#include "log/events_table.h"
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
#include "timing_test.h"
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

/// Lock the participant's folder, so that no second session writes there; in a dry run, see whether that
/// could be.
std::optional<FolderLock> lock_participant(const SessionOptions& options) {
    const fs::path folder = options.study / ("sub-" + options.participant);
    std::optional<FolderLock> lock;
    const bool free = options.dry_run ? FolderLock::is_free(folder) : [&] {
        auto attempted = FolderLock::attempt(folder);
        if (attempted) {
            lock.emplace(std::move(*attempted));
        }
        return lock.has_value();
    }();
    if (!free) {
        throw support::input_error(
            "{}: expected a participant without a session, found another session at it", folder.string());
    }
    return lock;
}

/// What a table of frames calls a run.
std::string run_name(const SessionOptions& options, const SessionPlan& plan) {
    return fmt::format("sub-{}_run-{:02d}", options.participant, plan.run);
}

/// Remark on a disk that has hardly room for a study.
void note_little_room(const fs::path& study, SessionPlan& plan) {
    constexpr std::uintmax_t little = std::uintmax_t{128} << 20; // bytes
    std::error_code unknown;
    const auto space = fs::space(support::existing_part(study), unknown);
    if (!unknown && space.available < little) {
        plan.remarks.push_back(
            fmt::format("{}: its disk has only {} MB left", study.string(), space.available >> 20));
    }
}

Preparation prepare(const SessionOptions& options) {
    check_label(options.participant);
    study::Protocol protocol = study::read_protocol(options.protocol);
    auto observer = options.observer ? std::optional(Observer(*options.observer, protocol)) : std::nullopt;
    StimulusSet stimuli(options.stimuli, stimuli_of(make_schedule(protocol, 0)), protocol.image.width,
                        protocol.image.height);
    StudyFolder study(options.study, observer.has_value(), protocol.name);
    std::optional<FolderLock> lock;
    if (!options.print_order) {
        if (auto held = lock_participant(options)) {
            lock.emplace(std::move(*held));
        }
    }
    SessionPlan plan = make_plan(
        options, protocol, {stimuli.manifest_digest(), observer ? observer->digest() : std::string("n/a")});
    note_little_room(options.study, plan);
    if (stimuli.protocol_digest() != protocol.digest) {
        plan.remarks.push_back(fmt::format("{}: rendered by another version of the protocol than {}",
                                           (options.stimuli / "manifest.json").string(),
                                           options.protocol.string()));
    }
    if (options.frames) {
        FrameTable::check(*options.frames, plan.resumes(), run_name(options, plan));
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
        } catch (const Interrupted&) {
            throw;
        } catch (const std::runtime_error& error) {
            if (!stage.tell_trouble(error.what())) {
                throw;
            }
        }
    }
}

/// The log of the plan's run, created or gone on with.
SessionLog open_log(const SessionOptions& options, const SessionPlan& plan) {
    return plan.log ? SessionLog::resume(log_path(options.study, options.participant, plan.run), *plan.log)
                    : SessionLog::create(options.study, options.participant);
}

/// What a running session writes to.
struct Files {
    SessionLog& log;
    Sidecar& sidecar;
    std::function<void()> restore_study; ///< writes anew what was deleted of the study's own files

    void restore() const {
        log.restore();
        restore_study();
    }
    /// Write the sidecar; where that fails, or the log is gone, say so, bring back what is missing and try
    /// again.
    void keep(Stage& stage) const {
        bool again = false;
        write_with_retries(stage, [&] {
            if (std::exchange(again, true)) {
                restore();
            }
            log.check_unchanged();
            sidecar.write();
        });
    }
    /// Write what can be written when nobody is there to ask; what to say of it.
    std::string close(const std::string& reason, std::size_t trials) const {
        try {
            restore();
            sidecar.write();
        } catch (const std::runtime_error&) {
            // The sidecar as it is says "not complete".
        }
        const std::string path = log.path().string();
        if (!log.in_place()) {
            fmt::print(stderr, "skin2afc: note: {} is gone; it held:\n{}", path, log.content());
            return fmt::format("{}; the log {} is gone, its {} of {} trials are printed above", reason, path,
                               log.answers(), trials);
        }
        return fmt::format("{}; {} of {} trials are saved in {}", reason, log.answers(), trials, path);
    }
};

/// Where this fails, nothing is lost: the events are made from the log.
void keep_events(const SessionLog& log, const KeptStimuli& kept) {
    try {
        write_events(log, kept);
    } catch (const std::runtime_error& error) {
        fmt::print(stderr, "skin2afc: note: {}\n", support::one_line(error.what()));
    }
}

/// Run the trials and record in the sidecar how they ended.
void run_to_the_end(const Preparation& ready, Stage& stage, const Files& files, FrameTable& frames,
                    const KeptStimuli& kept) {
    const study::SessionSettings& session = ready.protocol.session;
    const Schedule& schedule = ready.plan.schedule;
    Timing timing;
    const Setting setting{
        .session = session,
        .schedule = schedule,
        .practice = practice_trials(schedule, static_cast<std::size_t>(session.practice), ready.plan.seed),
        .clock_start_s = files.sidecar.clock_start_s(ready.plan.log ? ready.plan.log->last_s : 0),
        .note = [&](const std::vector<Event>& events) { files.sidecar.note(events); },
        .keep = [&] { files.keep(stage); },
        .restore = [&] { files.restore(); },
        .between_trials = [&] { frames.write(); },
        .timing = &timing};
    try {
        run_trials(setting, stage, files.log);
        keep_events(files.log, kept); // before the sidecar calls the run complete
        files.sidecar.finish(files.log.answers(), "all trials answered", stage, timing);
        files.keep(stage);
    } catch (const std::runtime_error& error) {
        const std::string reason = support::one_line(error.what());
        files.sidecar.finish(files.log.answers(), reason, stage, timing);
        const std::string saved = files.close(reason, schedule.size());
        keep_events(files.log, kept);
        throw support::Failure(saved);
    }
    tell_timing(stage.facts(), ready.protocol.session.grey_s, timing);
    try {
        run_end_page(session, schedule, stage);
    } catch (const Interrupted&) {
        return; // leaving at the last page loses nothing
    }
}

/// What the participant said before the trials.
struct Said {
    std::optional<double> consent_s; ///< when, by the system's clock
    Answers answers;
};

/// Ask the participant what comes before the trials. Throws support::Failure where there is no consent.
Said run_forms(const SessionOptions& options, const Preparation& ready, Stage& stage) {
    const study::SessionSettings& session = ready.protocol.session;
    Said said;
    if (!ready.plan.resumes() && !session.texts.consent.empty()) {
        if (!ask_consent(session.texts, stage)) {
            run_declined_page(session, stage);
            throw support::failure("the participant did not agree to take part; nothing was written");
        }
        said.consent_s = system_clock_s();
    }
    const bool asks = !session.questions.empty() && ready.plan.answered() < ready.plan.schedule.size() &&
                      !has_answered(options.study, options.participant);
    said.answers = asks ? ask_questions(session, stage) : Answers{};
    return said;
}

/// Write what belongs to the study, as far as it is not there yet; the copies of the stimuli that it has.
KeptStimuli prepare_study(const SessionOptions& options, const Preparation& ready, const Answers& answers,
                          const std::function<void()>& tell) {
    ready.study.prepare(ready.protocol.title, options.participant, tell);
    support::remove_leftovers(
        log_path(options.study, options.participant, ready.plan.run).parent_path()); // locked
    if (!answers.empty()) {
        save_answers(options.study, options.participant, ready.protocol.session.questions, answers, tell);
    }
    // No session waits for pictures that can be copied later.
    KeptStimuli kept;
    try {
        ready.study.keep_stimuli(ready.stimuli, kept);
        ready.study.keep_contact_sheet(ready.stimuli.folder() / "contact_sheet.png");
    } catch (const Interrupted&) {
        throw;
    } catch (const std::runtime_error& error) {
        fmt::print(stderr, "skin2afc: note: {}\n", support::one_line(error.what()));
    }
    return kept;
}

void run_on(const SessionOptions& options, const Preparation& ready, Stage& stage, FrameTable& frames) {
    const study::Protocol& protocol = ready.protocol;
    Said said;
    try {
        if (!ready.observer) {
            stage.ask(start_page(options, protocol, ready.stimuli, ready.plan, stage.facts()));
        }
        said = run_forms(options, ready, stage);
    } catch (const Interrupted& reason) {
        throw support::failure("{} before the first trial; nothing was written", reason.what());
    }

    // Open the files before the first picture.
    std::optional<SessionLog> log;
    const auto tell = [&] {
        const std::size_t next = 1 + (log ? log->answers() : 0);
        stage.show(Page{fill_in(protocol.session.texts.waiting, next, ready.plan.schedule.size())});
    };
    KeptStimuli kept;
    write_with_retries(stage, [&] { kept = prepare_study(options, ready, said.answers, tell); });
    std::optional<StudyCopy> copy;
    write_with_retries(stage, [&] { copy.emplace(options.study); });
    write_with_retries(stage, [&] { log.emplace(open_log(options, ready.plan)); });
    Sidecar sidecar(log->sidecar_path(), protocol, ready.plan, ready.stimuli.manifest_digest(),
                    stage.facts());
    if (said.consent_s) {
        sidecar.note_consent(*said.consent_s);
    }
    const Files files{*log, sidecar, [&] {
                          copy->restore(tell);
                          kept = prepare_study(options, ready, said.answers, tell);
                      }};
    // A torn line is taken off the log when the sidecar has it.
    write_with_retries(stage, [&] { sidecar.write(); });
    write_with_retries(stage, [&] { log->settle(); });
    run_to_the_end(ready, stage, files, frames, kept);
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
    const auto parts = ready.plan.resumes() ? ready.plan.sidecar["Parts"].size() : 0;
    FrameTable frames(options.frames, *stage, run_name(options, ready.plan), parts + 1);
    run_on(options, ready, *stage, frames);
}

} // namespace experiment
