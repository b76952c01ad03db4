// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "procedure.h"

#include <utility>

#include <fmt/format.h>

#include <support/error.h>

namespace experiment {
namespace {

void replace_all(std::string& text, std::string_view from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

/// Show a page until space is pressed; returns its onset.
double show_page(const std::string& text, Stage& stage) {
    while (true) {
        try {
            const double onset_s = stage.show(Page{text});
            stage.wait_for({Key::space});
            return onset_s;
        } catch (const Disturbed&) { // show it again
        }
    }
}

/// One run through the trials.
class Procedure {
public:
    Procedure(const Setting& setting, Stage& stage, SessionLog& log)
        : setting_(setting), texts_(setting.session.texts), stage_(stage), log_(log) {}

    void run() {
        try {
            run_all();
        } catch (...) {
            // Pass on what happened before; the reason itself is the caller's to tell.
            take_events(log_.answers() + 1);
            pass_events_on();
            throw;
        }
    }

private:
    void run_all() {
        const std::size_t trials = setting_.schedule.size();
        if (log_.answers() >= trials) {
            return; // only the end is missing
        }
        start_s_ = show_page(fill_in(texts_.instructions, 0, trials), stage_) - setting_.clock_start_s;
        if (log_.answers() == 0 && !setting_.practice.empty()) {
            run_practice();
        }
        const std::size_t first = log_.answers();
        for (std::size_t i = first; i < trials; ++i) {
            const auto every = static_cast<std::size_t>(setting_.session.pause_every);
            if (every > 0 && i > first && i % every == 0) {
                show_page(fill_in(texts_.pause, i, trials), stage_);
            }
            stage_.begin_trial(i + 1);
            Press press{};
            const Answer answer =
                run_trial(setting_.schedule[i], fill_in(texts_.trial, i + 1, trials), i + 1, press);
            save(answer, i + 1);
            if (setting_.timing) {
                setting_.timing->grey_error_s.push_back(grey_error_s_);
                setting_.timing->save_s.push_back(stage_.now_s() - press.time_s);
            }
            take_events(i + 1);
            tell_events();
            if (setting_.between_trials) {
                setting_.between_trials();
            }
        }
        stage_.begin_trial(0);
    }

    void run_practice() {
        for (std::size_t i = 0; i < setting_.practice.size(); ++i) {
            Press press{};
            run_trial(setting_.practice[i], fill_in(texts_.practice, i + 1, setting_.practice.size()), 0,
                      press);
        }
        const std::string early = std::exchange(told_early_, false) ? texts_.early + "\n\n" : "";
        show_page(early + texts_.practice_end, stage_);
        tell_events();
    }

    /// Show one trial until it is answered undisturbed.
    Answer run_trial(const Trial& trial, const std::string& number, std::size_t at, Press& press) {
        while (true) {
            try {
                // Announce the trial, and say where a key came too early in the last one.
                const std::string early = std::exchange(told_early_, false) ? "\n\n" + texts_.early : "";
                show_page(number + early, stage_);
                return show_pair(trial, at, press);
            } catch (const Disturbed& reason) {
                events_.push_back({stage_.now_s() - start_s_, at,
                                   fmt::format("{}; the trial was shown again", reason.what())});
            }
        }
    }

    Answer show_pair(const Trial& trial, std::size_t at, Press& press) {
        const study::SessionSettings& session = setting_.session;
        const double onset_first_s = stage_.show(trial.first_stimulus());
        stage_.wait_for({Key::space});
        const double onset_grey_s = stage_.show(Grey{session.grey_level});
        const double onset_second_s = stage_.show_after(session.grey_s, trial.second_stimulus());
        press = stage_.wait_for({Key::one, Key::two});
        grey_error_s_ = onset_second_s - onset_grey_s - session.grey_s;

        if (const int early = stage_.take_early_answers(); early > 0) {
            told_early_ = true;
            events_.push_back({press.time_s - start_s_, at,
                               fmt::format("answers before the second picture, ignored: {}", early)});
        }
        return {.trial = trial,
                .response = press.key == Key::one ? 1 : 2,
                .response_time_s = press.time_s - onset_second_s,
                .onset_first_s = onset_first_s - start_s_,
                .onset_grey_s = onset_grey_s - start_s_,
                .onset_second_s = onset_second_s - start_s_};
    }

    /// Save the answer before anything else is shown; where that fails, say so and try again as long as is
    /// wished.
    void save(const Answer& answer, std::size_t at) {
        for (bool again = false;; again = true) {
            try {
                if (again) {
                    log_.restore();
                    if (setting_.restore) {
                        setting_.restore();
                    }
                }
                log_.append(answer);
                return;
            } catch (const std::runtime_error& failure) {
                events_.push_back({stage_.now_s() - start_s_, at, failure.what()});
                bool tries_again = false;
                try {
                    tries_again = stage_.tell_trouble(failure.what());
                } catch (const Interrupted&) {
                    save_at_last(answer, at);
                    throw;
                }
                if (!tries_again) {
                    save_at_last(answer, at);
                    throw;
                }
            }
        }
    }

    /// The session ends: try once more, and print an answer that finds no place.
    void save_at_last(const Answer& answer, std::size_t at) {
        try {
            log_.restore();
            log_.append(answer);
        } catch (const std::runtime_error&) {
            std::string row = log_row(at, answer);
            replace_all(row, "\t", " ");
            row.pop_back(); // the line's end
            events_.push_back({stage_.now_s() - start_s_, at, "an answer was not saved: " + row});
            fmt::print(stderr, "skin2afc: note: an answer was not saved: {}\n", row);
        }
    }

    void take_events(std::size_t at) {
        for (Note& note : stage_.take_notes()) {
            events_.push_back({note.time_s - start_s_, at, std::move(note.what)});
        }
    }

    bool pass_events_on() {
        if (events_.empty() || !setting_.note) {
            return false;
        }
        setting_.note(std::exchange(events_, {}));
        return true;
    }

    void tell_events() {
        if (pass_events_on() && setting_.keep) {
            setting_.keep();
        }
    }

    const Setting& setting_;
    const study::SessionTexts& texts_;
    Stage& stage_;
    SessionLog& log_;
    double start_s_ = 0, grey_error_s_ = 0;
    bool told_early_ = false;
    std::vector<Event> events_;
};

} // namespace

std::string fill_in(const std::string& text, std::size_t trial, std::size_t trials) {
    std::string filled = text;
    replace_all(filled, "{trial}", std::to_string(trial));
    replace_all(filled, "{trials}", std::to_string(trials));
    return filled;
}

void run_trials(const Setting& setting, Stage& stage, SessionLog& log) {
    Procedure(setting, stage, log).run();
}

void run_declined_page(const study::SessionSettings& session, Stage& stage) {
    show_page(session.texts.declined, stage);
}

void run_end_page(const study::SessionSettings& session, const Schedule& schedule, Stage& stage) {
    show_page(fill_in(session.texts.end, schedule.size(), schedule.size()), stage);
}

} // namespace experiment
