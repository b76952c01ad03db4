// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <experiment/command.h>

#include <memory>

#include <CLI/CLI.hpp>

#include <support/number_range.h>

#include "session.h"
#include "timing_test.h"

namespace experiment {
namespace {

constexpr const char* footer = R"(DESCRIPTION
  Shows the pictures of a stimulus set in pairs and logs which of the two was chosen. The experimenter's start page
  says what will happen, and warns; Enter begins. Then come, as far as the protocol has them, consent, questions,
  instructions and practice. Each trial is: the trial's number, space, the first picture, space, a grey screen
  (grey_s of the protocol), the second picture until 1 or 2 is pressed (number row or keypad). Every pair of the
  protocol is shown in both orders, in an order shuffled by the seed; which order comes first is balanced over the
  participants who have finished, unless --seed is given.

  One pixel of a picture is one pixel of the screen. All pictures are checked against the manifest and loaded before
  the first trial. Swaps are paced by the display's refresh where it can be measured, else by the clock; the sidecar
  says which. An answer is on the disk before the next trial is drawn. Escape does nothing, closing the window asks;
  the keys that the protocol names (session.leave, Ctrl+Shift+Q unless given) end the session early, as SIGINT,
  SIGTERM and SIGHUP do. The answers so far stay.

RESUMING
  A session that was ended early, killed or cut off goes on when the same command is given again: at the first trial
  without answer, in the order of its start, in the same log, whose torn last line, if any, is set aside. After a
  complete run the participant gets a new run number. Two sessions of one participant cannot run at once.

OBSERVERS for --simulate
  paper      chooses as often as the participants of Jimenez, Sundstedt and Gutierrez (2009, Table II) did
  null       tosses a coin
  FILE.toml  default = 0.5, then [[condition]] tables with any of test, distance, azimuth_deg, and
             reference_proportion, the share of choices of the reference; the last that matches holds;
             lapse_rate, interval_bias, spread and a table [response_time], see protocols/FORMAT.md
  A simulated session runs without window and says in every file that it is simulated. A study holds either
  simulated or real participants, never both.

FILES WRITTEN
  STUDY/dataset_description.json, participants.tsv, participants.json          once a study, a row once a participant
  STUDY/README.md                                                              what a reader needs, unless there is a README
  STUDY/stimuli/contact_sheet.png, DIGITS/*.png                                copied from the stimuli, once a set
  STUDY/task-skin2afc_events.json                                              what the columns of events mean
  STUDY/sub-LABEL/beh/sub-LABEL_task-skin2afc_run-NN_beh.tsv                   the log, one row an answered trial
  STUDY/sub-LABEL/beh/sub-LABEL_task-skin2afc_run-NN_beh.json                  its sidecar: seed, digests, timing
  STUDY/sub-LABEL/beh/sub-LABEL_task-skin2afc_run-NN_events.tsv                the pictures one by one, with their files
  STUDY/phenotype/questionnaire.tsv, questionnaire.json                        answers beside age, sex and handedness
  No file of a run is overwritten by another run.

EXIT STATUS
  0  all trials were answered
  1  the session ended early, there was no consent, it could not start for want of a display, a font or disk space, or
     the timing test found times that are not acceptable
  2  bad usage or bad input; nothing was written

EXAMPLE
  skin2afc session protocols/jimenez2009.toml --stimuli out/stimuli --study out/study --participant 01
  skin2afc session protocols/jimenez2009.toml --stimuli out/stimuli --study out/simulated --participant s01 \
      --simulate paper
  skin2afc session --timing-test)";

// JSON readers keep whole numbers exactly up to here.
constexpr std::uint64_t largest_seed = (std::uint64_t{1} << 53) - 1;

/// What only a session needs, and a test of the timing does not.
void require(const char* name, bool given) {
    if (!given) {
        throw CLI::RequiredError(name);
    }
}

void add_screen_options(CLI::App& session, ScreenOptions& screen) {
    session.add_flag("--windowed", screen.windowed,
                     "Show a window of the pictures' size; default: full screen on the monitor");
    session
        .add_option("--monitor", screen.monitor,
                    "Which monitor to show pictures on; 1, the primary one, unless given")
        ->check(CLI::Range(1, 64))
        ->type_name("N");
    session
        .add_option("--distance-cm", screen.distance_cm,
                    "From the eyes to the screen; default: the protocol's [display]")
        ->check(support::number_range(1.0, 1e5))
        ->type_name("CM");
    session
        .add_option(
            "--screen-width-mm", screen.screen_width_mm,
            "Width of the whole screen; default: the protocol's [display], else what the monitor says")
        ->check(support::number_range(1.0, 1e6))
        ->type_name("MM");
}

void add_run_options(CLI::App& session, SessionOptions& options) {
    session.add_flag("--new-run", options.new_run,
                     "Begin a run of its own even where the participant's last one was broken off");
    session.add_flag("--dry-run", options.dry_run,
                     "Check everything, show and write nothing, say what would be done");
    session.add_flag("--print-order", options.print_order,
                     "Print the trials in the order they would be shown, and show and write nothing");
    session
        .add_option(
            "--frames", options.frames,
            "Write the times of every picture shown to a table, trial by trial; a name that is free, or the "
            "table of the run that is gone on with")
        ->type_name("FILE");
}

} // namespace

void add_command(CLI::App& app) {
    const auto options = std::make_shared<SessionOptions>();
    const auto timing_s = std::make_shared<double>(0);
    CLI::App* session = app.add_subcommand("session", "Run one participant's session and log the answers");
    session->add_option("PROTOCOL", options->protocol, "The study's protocol, a TOML file; required");
    session->add_option("--stimuli", options->stimuli, "Folder written by \"skin2afc stimuli\"; required")
        ->type_name("DIR");
    session
        ->add_option("--study", options->study,
                     "Folder of the study's data, made where there is none; required")
        ->type_name("DIR");
    session
        ->add_option("--participant", options->participant,
                     "1 to 64 letters and digits, written as sub-LABEL; required")
        ->type_name("LABEL");
    session
        ->add_option(
            "--seed", options->seed,
            "Seed of the trial order, and of a simulated participant; default: made from the protocol's "
            "name and the label, with orders balanced over the participants who have finished")
        ->check(CLI::Range(std::uint64_t{0}, largest_seed))
        ->type_name("N");
    session->add_option("--simulate", options->observer, "Simulate the participant: paper, null or FILE.toml")
        ->type_name("OBSERVER");
    add_screen_options(*session, options->screen);
    add_run_options(*session, *options);
    CLI::Option* timing =
        session
            ->add_option("--timing-test", *timing_s,
                         "Show grey and pictures in turn for so many seconds (60 unless given), "
                         "print how exact their times are; needs nothing else")
            ->expected(0, 1)
            ->default_str("60")
            ->check(support::number_range(1.0, 86400.0))
            ->type_name("SECONDS");
    session->footer(footer);
    session->callback([options, timing, timing_s, session] {
        if (*timing) {
            for (const char* name : {"--simulate", "--stimuli", "--study", "--participant", "--frames"}) {
                if (session->count(name) > 0) {
                    throw CLI::ExcludesError("--timing-test", name);
                }
            }
            return run_timing_test(*options, timing->as<double>());
        }
        for (const char* name : {"PROTOCOL", "--stimuli", "--study", "--participant"}) {
            require(name, session->count(name) > 0);
        }
        run_session(*options);
    });
}

} // namespace experiment
