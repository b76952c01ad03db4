// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "start_page.h"

#include <fmt/format.h>

#include "log/sidecar.h"
#include "window/display.h"

namespace experiment {
namespace {

std::string refresh_text(const StageFacts& stage) {
    if (stage.refresh_hz) {
        return fmt::format("{:.2f} Hz, measured", *stage.refresh_hz);
    }
    return stage.pacing == "clock" ? "none that could be measured; the clock paces" : "n/a";
}

std::string orders_text(const SessionOptions& options, const SessionPlan& plan) {
    if (plan.resumes()) {
        return "as the run began";
    }
    return options.seed ? "as the seed has them"
                        : fmt::format("balanced, finished participants: {}", plan.finished_participants);
}

std::string angle_text(const StageFacts& stage) {
    if (!stage.stimulus_width_deg) {
        return "unknown: give --screen-width-mm and --distance-cm";
    }
    return fmt::format("{:.1f} degrees wide, from {:.0f} cm", *stage.stimulus_width_deg,
                       stage.viewing_distance_mm.value_or(0) / 10);
}

} // namespace

Form start_page(const SessionOptions& options, const study::Protocol& protocol, const StimulusSet& stimuli,
                const SessionPlan& plan, const StageFacts& stage) {
    Form form;
    form.id = "start";
    form.heading = protocol.title;
    form.text = fmt::format("Participant {}, run {:02d}", options.participant, plan.run);
    form.facts = {{"Trials", plan.resumes() ? fmt::format("goes on at trial {} of {}{}", plan.answered() + 1,
                                                          plan.schedule.size(),
                                                          plan.answered() > 0 ? ", without practice" : "")
                                            : fmt::format("{}, {} for practice before", plan.schedule.size(),
                                                          protocol.session.practice)},
                  {"Seed", fmt::format("{}", plan.seed)},
                  {"Orders", orders_text(options, plan)},
                  {"Stimuli", fmt::format("{} pictures of {} x {}, unchanged (manifest {})",
                                          stimuli.files().size(), protocol.image.width, protocol.image.height,
                                          stimuli.manifest_digest().substr(0, 12))},
                  {"Study", fs::absolute(options.study).lexically_normal().string()},
                  {"Monitor", stage.monitor},
                  {"Refresh", refresh_text(stage)},
                  {"Stimulus", angle_text(stage)},
                  {"To end a session", text_of(protocol.session.leave)}};
    form.warnings = plan.remarks;
    for (const std::string& change : screen_changes(plan.sidecar, stage)) {
        form.warnings.push_back("another screen than before: " + change);
    }
    form.warnings.insert(form.warnings.end(), stage.warnings.begin(), stage.warnings.end());
    form.next = "Enter: begin";
    form.more = protocol.session.texts.more;
    return form;
}

void print_order(const Schedule& schedule) {
    fmt::print("trial\treference\ttest\tdistance\tazimuth_deg\tfirst\tsecond\n");
    for (std::size_t i = 0; i < schedule.size(); ++i) {
        const Trial& trial = schedule[i];
        fmt::print("{}\t{}\t{}\t{}\t{}\t{}\t{}\n", i + 1, trial.reference, trial.test, trial.distance,
                   trial.azimuth_deg, trial.first, trial.second);
    }
}

void print_dry_run(const SessionOptions& options, const study::Protocol& protocol, const StimulusSet& stimuli,
                   const SessionPlan& plan) {
    StageFacts stage;
    stage.pacing = "simulated";
    if (!options.observer) {
        stage = look_at_display(protocol, plan.schedule.size(), options.screen);
    }
    const Form form = start_page(options, protocol, stimuli, plan, stage);
    fmt::print("{}\n{}\n", form.heading, form.text);
    for (const auto& [name, value] : form.facts) {
        fmt::print("  {:<18}{}\n", name, value);
    }
    for (const std::string& warning : form.warnings) {
        fmt::print("  warning: {}\n", warning);
    }
    fmt::print("All checks passed; nothing was shown or written.\n");
}

} // namespace experiment
