// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/command.h>
#include <stimuli/head.h>

#include <array>
#include <charconv>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <support/error.h>
#include <support/number_range.h>

#include "head_command.h"

namespace stimuli {
namespace {

constexpr const char* footer = R"(DESCRIPTION
  Writes the built-in head, or a relative of it, as a binary glTF 2.0 file that any viewer or renderer opens: closed
  lids, no hair, neck and shoulders. Metres, +Y up, the face towards +Z, 232 mm from chin to vertex. One watertight
  mesh, one chart with its seam at the back. The same options give the same file on the same machine.

  Maps, as PNG: albedo, normals, roughness with the strength of the reflection in alpha (2048 x 2048;
  KHR_materials_specular), and the thickness of the flesh below each place (512 x 512, KHR_materials_volume: green, 1
  being 40 mm). KHR_materials_ior says 1.4, a reflectance of 0.028 before that strength.

  Without options it is the head that other commands use when they get no --model.

SKIN
  Colour follows from melanin in the epidermis and blood in the dermis. --skin takes a Fitzpatrick type, or the share
  of the epidermis that is melanosomes, 0 to 0.5:
    I 0.006   II 0.0225   III 0.042   IV 0.08   V 0.16   VI 0.29

AGE
  18 to 90. Lines on forehead, around eyes and mouth, on cheeks and neck; sagging; age spots; grey brows.

LEVELS
  full    59,000 triangles
  fifth   a fifth of them, for heads a third of the picture high
  tenth   a tenth of them, for heads far away; near, lines and facets show

EXAMPLES
  skin2afc head --out head.glb
  skin2afc head --out elder.glb --age 70 --skin III --seed 7
  skin2afc stimuli protocols/jimenez2009.toml --out out/elder --model elder.glb

EXIT STATUS
  0 done; 1 writing failed; 2 bad usage or bad input, nothing was written)";

struct NamedSkin {
    std::string_view name;
    double melanin;
};
constexpr std::array<NamedSkin, 6> skins{
    {{"I", 0.0060}, {"II", 0.0225}, {"III", 0.042}, {"IV", 0.08}, {"V", 0.16}, {"VI", 0.29}}};

double melanin_of(const std::string& skin) {
    for (const NamedSkin& named : skins) {
        if (skin == named.name) {
            return named.melanin;
        }
    }
    double melanin = -1;
    const auto [end, error] = std::from_chars(skin.data(), skin.data() + skin.size(), melanin);
    if (error != std::errc() || end != skin.data() + skin.size() || !(melanin >= 0 && melanin <= 0.5)) {
        throw support::input_error(
            "--skin: expected I, II, III, IV, V, VI or a share of 0 to 0.5, found \"{}\"",
            support::one_line(skin));
    }
    return melanin;
}

constexpr double largest_seed = 9007199254740991; // 2^53 - 1, which every JSON reader has exactly

HeadDetail detail_of(const std::string& level) {
    constexpr std::array<std::pair<std::string_view, HeadDetail>, 3> levels{
        {{"full", HeadDetail::full}, {"fifth", HeadDetail::fifth}, {"tenth", HeadDetail::tenth}}};
    for (const auto& [name, detail] : levels) {
        if (level == name) {
            return detail;
        }
    }
    throw support::input_error("--level: expected full, fifth or tenth, found \"{}\"",
                               support::one_line(level));
}

struct Arguments {
    std::filesystem::path out;
    HeadSettings settings;
    std::string skin = "II", level = "full";
};

void run(Arguments& arguments) {
    arguments.settings.melanin = melanin_of(arguments.skin);
    const HeadDetail detail = detail_of(arguments.level);
    if (!(arguments.settings.age_years >= 18 && arguments.settings.age_years <= 90)) {
        throw support::input_error("--age: expected 18 to 90 years, found {}", arguments.settings.age_years);
    }
    if (arguments.out.extension() != ".glb") {
        throw support::input_error("--out: expected a file that ends in .glb, found \"{}\"",
                                   support::one_line(arguments.out.string()));
    }
    const std::filesystem::path folder = arguments.out.has_parent_path() ? arguments.out.parent_path() : ".";
    if (!std::filesystem::is_directory(folder)) {
        throw support::input_error("--out: {}: expected a folder, found none",
                                   support::one_line(folder.string()));
    }
    const renderer::scene::Model head = simplified(builtin_head(arguments.settings), detail);
    write_head(head, arguments.out);
    fmt::print("{}: {} triangles, {} bytes\n", arguments.out.string(), head.meshes.front().indices.size() / 3,
               std::filesystem::file_size(arguments.out));
}

} // namespace

void add_head_command(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("head", "Write the built-in head as a glTF model");
    command->add_option("--out", arguments->out, "File to write (.glb)")->required();
    command
        ->add_option("--seed", arguments->settings.seed,
                     "Which person: proportions, asymmetry, pores, freckles; 0 is the built-in head")
        ->check(support::number_range(0, largest_seed));
    command->add_option("--age", arguments->settings.age_years, "Years, 18 to 90 [45]");
    command->add_option("--skin", arguments->skin, "Fitzpatrick type, I to VI, or share of melanin [II]");
    command->add_option("--level", arguments->level, "Triangles kept: full, fifth or tenth [full]");
    command->footer(footer);
    command->callback([arguments] { run(*arguments); });
}

} // namespace stimuli
