// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "bench.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <support/error.h>

#include "accuracy/report.h"
#include "frames/command.h"
#include "gnuplot.h"
#include "outputs.h"

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

struct Arguments {
    AccuracyRequest request;
    std::string out, model, protocol;
};

void run(Arguments& arguments) {
    AccuracyRequest& request = arguments.request;
    const auto given = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
    };
    request.model_file = given(arguments.model);
    request.protocol_file = given(arguments.protocol);
    std::optional<Outputs> outputs;
    if (!arguments.out.empty()) {
        outputs.emplace(arguments.out);
        gnuplot_svg("set terminal svg\nplot x\n"); // a missing program is found before the long part
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

} // namespace

void add_bench(CLI::App& app) {
    CLI::App* bench = app.add_subcommand("bench", "Benchmarks");
    bench->require_subcommand(1);
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
