// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/command.h>
#include <stimuli/render_set.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "head_command.h"

namespace stimuli {
namespace {

constexpr const char* footer = R"(DESCRIPTION
  Renders the images of a protocol: every shader at every camera distance under every light azimuth. Each is
  DIR/<shader>_<distance>_<azimuth>.png, 8-bit sRGB, as participants see it. DIR/manifest.json lists them with digest
  and all parameters; DIR/contact_sheet.png shows them side by side.

  What is up to date is not rendered again: an image is rendered if it is new, if its file is missing or changed, or if
  any parameter it depends on has changed. Changing a parameter of one shader renders that shader's images alone.

  What images have in common is computed once: a shadow map and irradiance maps a light, a lit frame a light and
  camera. --shard I/N renders a run of the images, in the order light, distance, shader, so that most of that holds
  within each part, too. Parts differ by one image at most; several runs may fill one folder at once.

  Without --model, and without a model in the protocol, the built-in head is used. Any glTF 2.0 model (.glb, .gltf)
  will do: +Y up, the face towards +Z, metres. Its head is taken to be the top 232 mm unless the protocol's [model]
  table says otherwise.

SHADERS
  no_sss       no subsurface scattering
  ts           texture space (d'Eon and Luebke 2007): six Gaussians over an irradiance map
  ss_jittered  screen space, Hable's 13 jittered taps
  ss_full      screen space, six Gaussians (Jimenez, Sundstedt and Gutierrez 2009)
  reference    the ground truth, on the CPU: shadows by rays, scattering as a sum over the whole surface; rendered
               where the protocol lists it, or by --only shader=reference

EXAMPLES
  skin2afc stimuli protocols/jimenez2009.toml --out out/stimuli
  skin2afc stimuli protocols/jimenez2009.toml --out out/scan --model head.glb
  skin2afc stimuli protocols/jimenez2009.toml --out out/scan --model head.glb --only shader=ts,ss_full --only distance=zoom
  skin2afc stimuli protocols/jimenez2009.toml --out out/scan --model head.glb --only shader=reference

EXIT STATUS
  0 done; 1 rendering or writing failed; 2 bad usage or bad input, nothing was written)";

void print_costs(const SetReport& report) {
    std::vector<std::pair<std::string, renderer::passes::NodeCost>> rows(report.costs.begin(),
                                                                         report.costs.end());
    std::sort(rows.begin(), rows.end(),
              [](const auto& a, const auto& b) { return a.second.seconds > b.second.seconds; });
    std::map<std::string, int> reused;
    for (const Outcome& outcome : report.outcomes) {
        for (const std::string& pass : outcome.passes_reused) {
            ++reused[pass];
        }
    }
    fmt::print("\nwhere the time went{:>19} {:>6} {:>7}\n", "seconds", "runs", "reused");
    for (const auto& [what, cost] : rows) {
        fmt::print("  {:<28} {:>7.2f} {:>6} {:>7}\n", what, cost.seconds, cost.runs,
                   reused.contains(what) ? std::to_string(reused[what]) : "");
    }
}

/// "1200 triangles culled, 3 gaussians skipped".
std::string counts_text(const std::map<std::string, long long>& counts) {
    std::string text;
    for (const auto& [what, count] : counts) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
    }
    return text;
}

void print_explanation(const SetReport& report) {
    std::map<std::string, int> skipped;
    std::map<std::string, long long> counts;
    for (const Outcome& outcome : report.outcomes) {
        fmt::print("{:<28} {:<9} {}", outcome.name, outcome.rendered ? "rendered" : "kept", outcome.reason);
        if (outcome.rendered) {
            fmt::print("; {:.0f} ms; run: {}; reused: {}", outcome.milliseconds,
                       fmt::join(outcome.passes_run, ", "), fmt::join(outcome.passes_reused, ", "));
        }
        if (!outcome.passes_skipped.empty()) {
            fmt::print("; skipped: {}", fmt::join(outcome.passes_skipped, ", "));
        }
        if (!outcome.counts.empty()) {
            fmt::print("; counted: {}", counts_text(outcome.counts));
        }
        fmt::print("\n");
        for (const std::string& pass : outcome.passes_skipped) {
            ++skipped[pass];
        }
        for (const auto& [what, count] : outcome.counts) {
            counts[what] += count;
        }
    }
    for (const auto& [pass, images] : skipped) {
        fmt::print("skipped in {} images: {}\n", images, pass);
    }
    if (!counts.empty()) {
        fmt::print("counted in all: {}\n", counts_text(counts));
    }
    fmt::print("frames waiting to be encoded, at most: {}\n", report.most_waiting);
}

void run(const SetRequest& request, bool explain) {
    const SetReport report = render_set(request);
    for (const std::string& warning : report.warnings) {
        fmt::print(stderr, "skin2afc: warning: {}\n", warning);
    }
    const auto rendered =
        static_cast<std::size_t>(std::count_if(report.outcomes.begin(), report.outcomes.end(),
                                               [](const Outcome& outcome) { return outcome.rendered; }));
    if (explain) {
        print_explanation(report);
    }
    fmt::print("{} of {} images rendered, {:.1f} s, model: {}, OpenGL: {}\n", rendered,
               report.outcomes.size(), report.seconds, report.model, report.driver);
    if (report.missing > 0) {
        fmt::print("{} images of the protocol are not in {} yet\n", report.missing, request.out.string());
    }
    if (rendered > 0) {
        print_costs(report);
    }
}

} // namespace

void add_command(CLI::App& app) {
    struct Arguments {
        SetRequest request;
        std::string model;
        bool explain = false;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("stimuli", "Render the images of a protocol");
    SetRequest& request = arguments->request;
    command->add_option("PROTOCOL", request.protocol_file, "Protocol file (TOML)")->required();
    command->add_option("--out", request.out, "Folder for images, manifest and contact sheet")->required();
    command->add_option("--model", arguments->model,
                        "glTF model in place of the protocol's, or of the built-in head");
    command
        ->add_option("--only", request.only,
                     "Render these images alone: KEY=V[,V...], KEY being shader, distance or azimuth")
        ->allow_extra_args(false) // so that it does not swallow what follows its value
        ->take_all();
    command->add_option(
        "--shard", request.shard,
        "Render part I of N alone, as I/N, of what --only keeps; all parts together are the set");
    command->add_flag("--force", request.force, "Render images that are up to date, too");
    command->add_flag("--explain", arguments->explain,
                      "Say of each image why it was rendered or not, by which passes, and what was left out");
    command->add_flag("--exr", request.exr,
                      "Also write each image's linear light as .exr (half float, RGBA)");
    command->footer(footer);
    command->callback([arguments] {
        if (!arguments->model.empty()) {
            arguments->request.model_file = arguments->model;
        }
        run(arguments->request, arguments->explain);
    });
    add_head_command(app);
}

} // namespace stimuli
