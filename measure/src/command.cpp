// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <measure/command.h>

#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <study/protocol.h>
#include <support/error.h>

#include "bench.h"
#include "compare.h"

namespace measure {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer = R"(DESCRIPTION
  Measures how IMAGE differs from REFERENCE: two files, or two folders whose images of the same name are compared.
  Images are PNG (8 or 16 bits, sRGB) or OpenEXR (linear light). Of a folder with a manifest.json the images it
  lists count, of another one every .png and .exr but contact_sheet.png; each needs its twin in the other folder.
  Where both twins have a linear image (.exr) beside their PNG, that is measured; --png keeps to the PNGs.

  The object is where the alpha of either image is above zero. An image without alpha shows it where its colour is
  not the background's: the colour that the borders of both images hold most often. Where one border has none of
  that, every pixel counts.

ERRORS
  RMSE, PSNR   in linear light over the object; PSNR against the display's white
  dE           CIEDE2000 (D65) over the object: the mean, and what 95 % of the pixels do not exceed
  SSIM         of the display signal's luma, 11 x 11 Gaussian window, over the object; 1: the same
  FLIP         LDR-FLIP (Andersson et al. 2020) over all pixels, 0 to 1; it depends on the viewing conditions, by
               default FLIP's own: 3840 pixels on 700 mm seen from 700 mm, 67.02 pixels per degree

FILES WRITTEN, with --out
  DIR/errors.tsv              a row a pair: image, reference, rmse, psnr_db, de2000_mean, de2000_p95, ssim, flip,
                              rmse_all (over all pixels), object_pixels; numbers read back exactly
  DIR/<image>_flip.png        FLIP of each pixel: black 0, then purple, red, yellow, white 1
  DIR/<image>_difference.png  difference of the display signals times the gain

EXIT STATUS
  0  done
  1  it failed (a full disk)
  2  bad usage or bad input; nothing was written

EXAMPLES
  skin2afc compare out/a/ts_zoom_000.png out/b/ts_zoom_000.png
  skin2afc compare out/scan out/scan --against reference --out out/errors
  skin2afc compare out/new out/old --screen-width-mm 598 --screen-width-px 2560 --viewing-distance-mm 600)";

/// What the command line says.
struct Arguments {
    CompareRequest request;
    std::string out;
    fs::path protocol;
    std::optional<double> ppd, width_mm, width_px, distance_mm;
};

/// The viewing conditions: as numbers, of a protocol's screen, or FLIP's own.
double viewing(const Arguments& arguments) {
    double value = arguments.ppd.value_or(default_pixels_per_degree());
    if (!arguments.protocol.empty()) {
        const auto display = study::read_protocol(arguments.protocol).display;
        if (!display) {
            throw support::input_error("{}: display: expected the table with width_mm, width_px and "
                                       "distance_mm, found none",
                                       arguments.protocol.string());
        }
        value = pixels_per_degree(display->width_mm, display->width_px, display->distance_mm);
    } else if (arguments.width_mm) {
        value = pixels_per_degree(*arguments.width_mm, *arguments.width_px, *arguments.distance_mm);
    }
    if (!(value >= 1 && value <= 1000)) {
        throw support::input_error("viewing conditions: expected 1 to 1000 pixels per degree, found {}",
                                   value);
    }
    return value;
}

void run(Arguments& arguments) {
    if (!arguments.out.empty()) {
        arguments.request.out = arguments.out;
    }
    if (!(arguments.request.gain > 0 && arguments.request.gain <= 1e6)) {
        throw support::input_error("--gain: expected a number above 0, up to 1e6, found {}",
                                   arguments.request.gain);
    }
    arguments.request.pixels_per_degree = viewing(arguments);
    const std::vector<ErrorRow> rows = compare(arguments.request);
    fmt::print("{}FLIP at {:.2f} pixels per degree\n", to_text(rows), arguments.request.pixels_per_degree);
    if (arguments.request.out) {
        fmt::print("Written to {}: errors.tsv and two pictures a pair\n",
                   support::one_line(arguments.request.out->string()));
    }
}

void add_compare(CLI::App& app) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("compare", "Errors of an image, or of a folder of images");
    CompareRequest& request = arguments->request;
    command->add_option("IMAGE", request.image, "Image, or folder of images")->required();
    command->add_option("REFERENCE", request.reference, "What it should be: image, or folder of images")
        ->required();
    command->add_option("--out", arguments->out, "Folder for table and pictures; made if missing")
        ->type_name("DIR");
    command->add_option("--gain", request.gain, "Contrast of the difference pictures")
        ->capture_default_str()
        ->type_name("FACTOR");
    command
        ->add_option("--against", request.rules.against,
                     "Compare every image with REFERENCE's image of this shader and the same view")
        ->type_name("SHADER");
    command->add_flag("--png", request.rules.png_only, "In folders, leave linear images (.exr) aside");
    const auto number = [&](const char* name, std::optional<double>& value, const char* what) {
        return command->add_option(name, value, what)->type_name("NUMBER");
    };
    CLI::Option* ppd = number("--ppd", arguments->ppd, "Viewing conditions: pixels per degree");
    CLI::Option* width_mm =
        number("--screen-width-mm", arguments->width_mm, "Viewing conditions: the screen's width");
    CLI::Option* width_px =
        number("--screen-width-px", arguments->width_px, "Viewing conditions: its pixels in a row");
    CLI::Option* distance = number("--viewing-distance-mm", arguments->distance_mm,
                                   "Viewing conditions: from the eyes to the screen");
    width_mm->excludes(ppd)->needs(width_px)->needs(distance);
    width_px->needs(width_mm);
    distance->needs(width_mm);
    command->add_option("--protocol", arguments->protocol, "Viewing conditions: a protocol's table [display]")
        ->excludes(ppd)
        ->excludes(width_mm)
        ->type_name("FILE");
    command->footer(footer);
    command->callback([arguments] { run(*arguments); });
}

} // namespace

void add_command(CLI::App& app) {
    add_compare(app);
    add_bench(app);
}

} // namespace measure
