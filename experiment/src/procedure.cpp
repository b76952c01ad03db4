// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "procedure.h"

namespace experiment {
namespace {

void replace_all(std::string& text, std::string_view from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

} // namespace

std::string fill_in(const std::string& text, std::size_t trial, std::size_t trials) {
    std::string filled = text;
    replace_all(filled, "{trial}", std::to_string(trial));
    replace_all(filled, "{trials}", std::to_string(trials));
    return filled;
}

void run_trials(const study::SessionSettings& session, const Schedule& schedule, Stage& stage,
                SessionLog& log) {
    const std::size_t trials = schedule.size();
    // Start the session's clock with the instructions.
    const double start_s = stage.show(Page{fill_in(session.texts.instructions, 0, trials)});
    stage.wait_for({Key::space});

    for (std::size_t i = 0; i < trials; ++i) {
        const Trial& trial = schedule[i];
        // Announce the trial.
        stage.show(Page{fill_in(session.texts.trial, i + 1, trials)});
        stage.wait_for({Key::space});

        // Show the pair with the grey between.
        const double onset_first_s = stage.show(trial.first_stimulus());
        stage.wait_for({Key::space});
        const double onset_grey_s = stage.show(Grey{session.grey_level});
        const double onset_second_s = stage.show_after(session.grey_s, trial.second_stimulus());

        // Save the answer before anything else is shown.
        const Press answer = stage.wait_for({Key::one, Key::two});
        log.append({.trial = trial,
                    .response = answer.key == Key::one ? 1 : 2,
                    .response_time_s = answer.time_s - onset_second_s,
                    .onset_first_s = onset_first_s - start_s,
                    .onset_grey_s = onset_grey_s - start_s,
                    .onset_second_s = onset_second_s - start_s});
    }
}

void run_end_page(const study::SessionSettings& session, const Schedule& schedule, Stage& stage) {
    stage.show(Page{fill_in(session.texts.end, schedule.size(), schedule.size())});
    stage.wait_for({Key::space});
}

} // namespace experiment
