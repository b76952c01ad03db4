// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <experiment/command.h>

#include <memory>

#include <CLI/CLI.hpp>

#include "session.h"

namespace experiment {
namespace {

constexpr const char* footer = R"(DESCRIPTION
  Shows the pictures of a stimulus set in pairs and logs which of the two was chosen. After the instructions, each
  trial is: the trial's number, space, the first picture, space, a grey screen (grey_s of the protocol), the second
  picture until 1 or 2 is pressed (number row or keypad). Every pair of the protocol is shown in both orders, in an
  order shuffled by the seed.

  One pixel of a picture is one pixel of the screen. All pictures are checked against the manifest and loaded before
  the first trial. Swaps are paced by the display's refresh where it can be measured, else by the clock; the sidecar
  says which. An answer is on the disk before the next trial is drawn. Closing the window, or SIGINT, SIGTERM and
  SIGHUP, end the session early; the answers so far stay.

OBSERVERS for --simulate
  paper      chooses as often as the participants of Jimenez, Sundstedt and Gutierrez (2009, Table II) did
  null       tosses a coin
  FILE.toml  default = 0.5, then [[condition]] tables with any of test, distance, azimuth_deg, and
             reference_proportion, the share of choices of the reference; the last that matches holds
  A simulated session runs without window and says in every file that it is simulated. A study holds either
  simulated or real participants, never both.

FILES WRITTEN
  STUDY/dataset_description.json, participants.tsv, participants.json          once a study, a row once a participant
  STUDY/stimuli/contact_sheet.png                                              copied from the stimuli, once
  STUDY/sub-LABEL/beh/sub-LABEL_task-skin2afc_run-NN_beh.tsv                   the log, one row an answered trial
  STUDY/sub-LABEL/beh/sub-LABEL_task-skin2afc_run-NN_beh.json                  its sidecar: seed, digests, timing
  A participant's further sessions get the next run numbers; no file is overwritten.

EXIT STATUS
  0  all trials were answered
  1  the session ended early, or could not start for want of a display, a font or disk space
  2  bad usage or bad input; nothing was written

EXAMPLE
  skin2afc session protocols/jimenez2009.toml --stimuli out/stimuli --study out/study --participant 01
  skin2afc session protocols/jimenez2009.toml --stimuli out/stimuli --study out/simulated --participant s01 \
      --simulate paper)";

// JSON readers keep whole numbers exactly up to here.
constexpr std::uint64_t largest_seed = (std::uint64_t{1} << 53) - 1;

} // namespace

void add_command(CLI::App& app) {
    const auto options = std::make_shared<SessionOptions>();
    CLI::App* session = app.add_subcommand("session", "Run one participant's session and log the answers");
    session->add_option("PROTOCOL", options->protocol, "The study's protocol, a TOML file")->required();
    session->add_option("--stimuli", options->stimuli, "Folder written by \"skin2afc stimuli\"")
        ->required()
        ->type_name("DIR");
    session->add_option("--study", options->study, "Folder of the study's data, made where there is none")
        ->required()
        ->type_name("DIR");
    session
        ->add_option("--participant", options->participant,
                     "1 to 64 letters and digits, written as sub-LABEL")
        ->required()
        ->type_name("LABEL");
    session
        ->add_option(
            "--seed", options->seed,
            "Seed of the trial order, and of a simulated participant; default: made from the protocol's "
            "name and the label")
        ->check(CLI::Range(std::uint64_t{0}, largest_seed))
        ->type_name("N");
    session->add_option("--simulate", options->observer, "Simulate the participant: paper, null or FILE.toml")
        ->type_name("OBSERVER");
    session->add_flag("--windowed", options->windowed,
                      "Show a window of the pictures' size; default: full screen on the primary monitor");
    session->footer(footer);
    session->callback([options] { run_session(*options); });
}

} // namespace experiment
