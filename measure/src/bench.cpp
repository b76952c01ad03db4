// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "bench.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <support/error.h>
#include <support/gnuplot.h>

#include "accuracy/report.h"
#include "frames/command.h"
#include "outputs.h"
#include "set/set_bench.h"

namespace measure {
namespace {

constexpr const char* footer = R"(DESCRIPTION
  Measures what each setting of each real-time shader costs, and how far it is from the ground truth: the light
  transport that all of them approximate, computed on the CPU with the study's own profile.

  Every setting is checked before anything is timed: its light is finite, its silhouette is the reference's. Then
  each round times every setting in every view once, in an order drawn from a fixed seed, so that a machine that
  drifts hurts all alike. A time is that of a whole frame, from the shadow map to the finished bytes, under a light
  that no frame before had, so that nothing is reused; set-up is left out. Median and median absolute deviation.

SETTINGS
  no_sss       as it is
  ts           maps of 256 to 4096 texels; 4 or 6 Gaussians; the narrowest Gaussian blurred or not; 512 with the
               other number of Gaussians
  ss_full      7, 9, 13 or 25 taps; 4 or 6 Gaussians; the published form; published stretch, taps, or no rejection
               of gaps alone; 8, 16 or 32 bits; half resolution; the other number of Gaussians at half resolution and
               in the published form; 25 taps with 32 bits
  ss_jittered  13, 25 or 49 taps
  One axis is varied at a time around the protocol's own settings, the "default". Truth keeps the protocol's profile.

FILES WRITTEN, with --out
  DIR/accuracy.tsv      shader, setting, distance, azimuth_deg, time_ms, time_spread_ms, the errors of skin2afc
                        compare, scatter_ms and scatter_spread_ms (the scattering alone); numbers read back exactly
  DIR/accuracy.svg      time against FLIP, drawn by gnuplot
  DIR/accuracy.html     one self-contained page: findings, figure, the settings on the front, all settings
  DIR/closed_forms.tsv  scene, shader, setting, distance, rms_error (share of the lit level): planes half in light,
                        a lit dot, a sphere and a plane lit everywhere, whose light is known exactly

EXIT STATUS
  0  done
  1  it failed (no OpenGL, no gnuplot, frames that are not sound)
  2  bad usage or bad input; nothing was written

EXAMPLES
  skin2afc bench accuracy --out out/accuracy --quick
  skin2afc bench accuracy --out out/scan --model head.glb --azimuth 0,60,110,150)";

constexpr const char* set_footer = R"(DESCRIPTION
  Times a whole protocol, from the model's file to the contact sheet, by the code of skin2afc stimuli: with everything
  on, with each switch off by itself, with all off, by one run of the program, and by a run of the program for each
  image. Images of all ways are compared before anything is timed: a switch promises the same, bit for bit or to a
  stated bound. Then each round runs every way once, in an order drawn from a fixed seed, so that a machine that
  drifts hurts all alike.

SWITCHES
  everything   all of the following
  share        what images have in common is kept: shadow maps, lit frames, irradiance maps
  overlap      images are encoded and written while further ones are rendered
  program      one run: the program is started once; a run an image: once for each image
  Further switches are those of the renderer, by their names.

FILES WRITTEN, with --out
  DIR/set.tsv  switch, state, seconds (median), images, passes (run for all images), pixels (of all images),
               seconds_spread (median absolute deviation), cpu_seconds (of all threads), then what the renderer counts;
               numbers read back exactly

EXIT STATUS
  0  done
  1  it failed (no OpenGL, images that differ)
  2  bad usage or bad input; nothing was written

EXAMPLES
  skin2afc bench set --quick
  skin2afc bench set --out out/set --model head.glb)";

struct Arguments {
    AccuracyRequest request;
    std::string out, model, protocol;
};

struct SetArguments {
    SetBenchRequest request;
    std::string out, model, protocol;
};

std::optional<std::filesystem::path> given(const std::string& text) {
    return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
}

void run(Arguments& arguments) {
    AccuracyRequest& request = arguments.request;
    request.model_file = given(arguments.model);
    request.protocol_file = given(arguments.protocol);
    std::optional<Outputs> outputs;
    if (!arguments.out.empty()) {
        outputs.emplace(arguments.out);
        support::gnuplot_svg("set terminal svg\nplot x\n"); // a missing program is found before the long part
    }
    const AccuracyResult result = run_accuracy(request);
    const std::vector<Summary> all = summaries(result.rows);
    fmt::print("{}", accuracy_text(result, all));
    if (outputs) {
        const std::string svg = accuracy_svg(result, all);
        outputs->write("accuracy.tsv", accuracy_tsv(result.rows));
        outputs->write("closed_forms.tsv", closed_forms_tsv(result.closed_forms));
        outputs->write("accuracy.svg", svg);
        outputs->write("accuracy.html", accuracy_html(result, all, svg));
        outputs->commit();
        fmt::print("Written to {}: accuracy.tsv, accuracy.svg, accuracy.html, closed_forms.tsv\n",
                   support::one_line(arguments.out));
    }
}

void run_set_bench(SetArguments& arguments) {
    SetBenchRequest& request = arguments.request;
    request.model_file = given(arguments.model);
    request.protocol_file = given(arguments.protocol);
    std::optional<Outputs> outputs;
    if (!arguments.out.empty()) {
        outputs.emplace(arguments.out);
    }
    const SetResult result = run_set(request);
    fmt::print("{}", set_text(result));
    if (outputs) {
        outputs->write("set.tsv", set_tsv(result));
        outputs->commit();
        fmt::print("Written to {}: set.tsv\n", support::one_line(arguments.out));
    }
}

void add_set(CLI::App& bench) {
    const auto arguments = std::make_shared<SetArguments>();
    CLI::App* command = bench.add_subcommand("set", "Time of a whole set, with and without what saves some");
    command->add_option("--out", arguments->out, "Folder for the table; made if missing")->type_name("DIR");
    command
        ->add_option("--model", arguments->model,
                     "glTF model in place of the protocol's, or of the built-in head")
        ->type_name("FILE");
    command
        ->add_option("--protocol", arguments->protocol,
                     "Protocol that describes the set; default: the 2009 study")
        ->type_name("FILE");
    command
        ->add_option("--rounds", arguments->request.rounds,
                     "Timed runs of each way; default: 3, or 1 with --quick")
        ->check(CLI::Range(1, 200))
        ->type_name("N");
    command->add_flag("--quick", arguments->request.quick,
                      "A quarter of the images' and the shadow map's width and height, two distances and two "
                      "lights: a minute or two; the whole set: an hour on two cores");
    command->footer(set_footer);
    command->callback([arguments] { run_set_bench(*arguments); });
}

} // namespace

void add_bench(CLI::App& app) {
    CLI::App* bench = app.add_subcommand("bench", "Benchmarks");
    bench->require_subcommand(1);
    add_set(*bench);
    bench->footer("EXAMPLES\n  skin2afc bench accuracy --out out/accuracy --quick\n  skin2afc bench set "
                  "--out out/set --quick\n  skin2afc bench frames --out out/frames --quick");
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = bench->add_subcommand("accuracy", "Run time of every setting against its error");
    command->add_option("--out", arguments->out, "Folder for tables, figure and page; made if missing")
        ->type_name("DIR");
    command
        ->add_option("--model", arguments->model,
                     "glTF model in place of the protocol's, or of the built-in head")
        ->type_name("FILE");
    command
        ->add_option("--protocol", arguments->protocol,
                     "Protocol with the look and the views; default: those of the 2009 study")
        ->type_name("FILE");
    command
        ->add_option("--azimuth", arguments->request.azimuths_deg,
                     "Light azimuths, degrees; default: 60, or the protocol's first")
        ->delimiter(',')
        ->check(CLI::Range(0, 359))
        ->type_name("A[,A...]");
    command
        ->add_option("--rounds", arguments->request.rounds,
                     "Timed frames of each setting and view; default: 9, or 3 with --quick")
        ->check(CLI::Range(1, 200))
        ->type_name("N");
    command->add_flag("--quick", arguments->request.quick,
                      "A quarter of the images' and the shadow map's width and height, fewer settings, 3 "
                      "rounds: some minutes");
    command->footer(footer);
    command->callback([arguments] { run(*arguments); });
    add_bench_frames(*bench);
}

} // namespace measure
