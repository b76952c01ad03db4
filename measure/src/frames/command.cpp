// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "command.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <support/error.h>

#include "../outputs.h"
#include "frames.h"

namespace measure {
namespace {

constexpr const char* footer = R"(DESCRIPTION
  Measures how long a frame takes in the scenes of the papers' tables, and prints the ratios beside the papers' own.

  table3      Jimenez, Sundstedt & Gutierrez 2009, Table III: one, three and five heads, four shaders, 4x MSAA, one
              light, six Gaussians
  table7_2    Jimenez & Gutierrez 2010, Table 7.2: heads, lights and distances, at 1x and at the driver's highest
              MSAA up to 8x, four Gaussians. The paper's texture space is the single jittered pass of Hable et al.;
              here it is that of d'Eon & Luebke
  section7_5  the scenes of the text, at 1x: ten heads far away, five heads behind a plane, five heads outside of the
              view, five marble busts
  effects     scattering, bloom and depth of field, each by itself
  levels      the built-in head with all its triangles, a fifth and a tenth of them (skin2afc head --level): ten heads
              far away, and one; left out with --model
  own         the first scene of table3 with the shadow map of 4096 texels that this program's studies have; all
              others have the papers' 512

  Medium, unless said otherwise: a head of 232 mm fills a third of the picture's height, at 1974 mm and 20 degrees.
  Near: all of it, 658 mm. Far: a twelfth, 7894 mm. Heads stand side by side, in two rows where one is too wide.
  The model stands in its place as often as there are heads; texture space keeps a map of 1024 texels for each.

  ts is timed in its published form ("faithful"): an irradiance map for each head whether it can be seen or not, the
  lighting of the final pass as the narrowest Gaussian. "culled" is ts with maps lit and sized by what the camera sees.
  Out of view the program skips all of ts as well; there the faithful form is with culling off.

  Every setting is checked before anything is timed: its frames are finite, the same twice, empty only where they are
  to be, and the same from all shaders where the heads are hidden. Then each round times every scene and setting once,
  in an order drawn from a fixed seed, the settings of a scene side by side; scenes are timed in six blocks, so that
  memory holds their maps. Every frame has a new light and a new camera and computes all it needs; reading the picture
  back is left out. Times are wall time up to the end of the frame where OpenGL runs on the CPU, else GL_TIME_ELAPSED;
  those of scattering, bloom and depth of field by themselves are wall time up to the end of each. Median and median
  absolute deviation. Frames over those of faithful ts and the share of scattering far away are medians over the rounds
  of ratios within a round; frames over those of culled ts and the growth from one to five heads are ratios of medians.

FILES WRITTEN, with --out
  DIR/frames.tsv  table, axis, value, shader, msaa, time_ms, time_spread_ms, fps, fps_over_ts, published_fps_over_ts,
                  setting, published_fps, skin_pixels; numbers read back exactly, n/a where there is none. For effects,
                  the setting is the effect: scattering, bloom or depth_of_field
  DIR/frames.txt  what is printed: the tables, and each target with whether it is reached

EXIT STATUS
  0  done
  1  it failed (no OpenGL, frames that are not sound)
  2  bad usage or bad input; nothing was written

EXAMPLES
  skin2afc bench frames --quick
  skin2afc bench frames --model head.glb --bust bust.glb --out out/frames)";

struct Arguments {
    FramesRequest request;
    std::string out, model, bust;
};

void run(Arguments& arguments) {
    const auto given = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
    };
    arguments.request.model_file = given(arguments.model);
    arguments.request.bust_file = given(arguments.bust);
    std::optional<Outputs> outputs;
    if (!arguments.out.empty()) {
        outputs.emplace(arguments.out);
    }
    const FramesResult result = run_frames(arguments.request);
    const std::string text = frames_text(result);
    fmt::print("{}", text);
    if (outputs) {
        outputs->write("frames.tsv", frames_tsv(result));
        outputs->write("frames.txt", text);
        outputs->commit();
        fmt::print("Written to {}: frames.tsv, frames.txt\n", support::one_line(arguments.out));
    }
}

} // namespace

void add_bench_frames(CLI::App& bench) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        bench.add_subcommand("frames", "Run time of frames in the scenes of the papers' tables");
    command->add_option("--out", arguments->out, "Folder for the tables; made if missing")->type_name("DIR");
    command->add_option("--model", arguments->model, "glTF model in place of the built-in head")
        ->type_name("FILE");
    command
        ->add_option("--bust", arguments->bust, "glTF model of the marble bust; default: the head, of marble")
        ->type_name("FILE");
    command
        ->add_option("--rounds", arguments->request.rounds,
                     "Timed frames of each scene and setting; default: 7, or 3 with --quick")
        ->check(CLI::Range(1, 200))
        ->type_name("N");
    command->add_option("--only", arguments->request.tables, "Time the scenes of these tables alone")
        ->delimiter(',')
        ->check(CLI::IsMember({"table3", "own", "table7_2", "section7_5", "effects", "levels"}))
        ->type_name("TABLE[,TABLE...]");
    command->add_flag("--quick", arguments->request.quick,
                      "Half of the width and height, a quarter of the pixels; fewer scenes; 3 rounds");
    command->footer(footer);
    command->callback([arguments] { run(*arguments); });
}

} // namespace measure
