// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <support/error.h>

#include "set_bench.h"

namespace measure {
namespace {

// What the whole set of 2009 is to reach: everything on against no sharing, one run of the program against a
// run an image, and seconds.
constexpr double most_of_unshared = 0.5, most_of_separate = 0.2, most_seconds = 20;

const SetRow* row_of(const SetResult& result, std::string_view name, std::string_view state) {
    const auto found = std::find_if(result.rows.begin(), result.rows.end(), [&](const SetRow& row) {
        return row.name == name && row.state == state;
    });
    return found == result.rows.end() ? nullptr : &*found;
}

/// The names of all that is counted, in the order of the alphabet.
std::set<std::string> counted(const SetResult& result) {
    std::set<std::string> names;
    for (const SetRow& row : result.rows) {
        for (const auto& [name, count] : row.counts) {
            names.insert(name);
        }
    }
    return names;
}

/// The row against which another stands: separate runs against one run of the program, all else against
/// everything on in this process.
const SetRow& base_of(const SetResult& result, const SetRow& row) {
    const SetRow* run = row_of(result, row_program, state_one_run);
    return row.name == row_program && run ? *run : result.rows.front();
}

std::string target_of(const SetRow& row) {
    if (row.name == "share" && row.state == "off") {
        return fmt::format("at most {}", most_of_unshared);
    }
    if (row.state == state_run_an_image) {
        return fmt::format("at most {}", most_of_separate);
    }
    if (row.state == state_one_run) {
        return fmt::format("under {} s", most_seconds);
    }
    return "";
}

} // namespace

std::string set_tsv(const SetResult& result) {
    const std::set<std::string> names = counted(result);
    std::string text = "switch\tstate\tseconds\timages\tpasses\tpixels\tseconds_spread\tcpu_seconds";
    for (std::string name : names) {
        std::replace(name.begin(), name.end(), ' ', '_');
        text += "\t" + name;
    }
    text += "\n";
    for (const SetRow& row : result.rows) {
        text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", row.name, row.state, row.seconds, row.images,
                            row.passes, row.pixels, row.seconds_spread, row.cpu_seconds);
        for (const std::string& name : names) {
            const auto found = row.counts.find(name);
            text += found == row.counts.end() ? "\tn/a" : fmt::format("\t{}", found->second);
        }
        text += "\n";
    }
    return text;
}

std::string set_text(const SetResult& result) {
    std::string text =
        fmt::format("{}: {} images of {}x{}{}, model {}, {} on {}, {}; medians of {} run{} a way\n\n",
                    result.protocol, result.rows.front().images, result.width, result.height,
                    result.quick ? " (quick: a quarter of the sides, two distances, two lights at most)" : "",
                    support::one_line(result.model), result.driver, result.processor, result.date,
                    result.rounds, result.rounds == 1 ? "" : "s");
    text += fmt::format("{:<26} {:<13} {:>8} {:>7} {:>8} {:>7} {:>9} {:>9}  {}\n", "switch", "state",
                        "seconds", "spread", "CPU s", "passes", "on / this", "CPU ratio", "to reach");
    for (const SetRow& row : result.rows) {
        const SetRow& base = base_of(result, row);
        text += fmt::format("{:<26} {:<13} {:>8.2f} {:>7.2f} {:>8.2f} {:>7} {:>9.3f} {:>9.3f}  {}\n",
                            row.name, row.state, row.seconds, row.seconds_spread, row.cpu_seconds, row.passes,
                            base.seconds / row.seconds, base.cpu_seconds / row.cpu_seconds, target_of(row));
    }
    text +=
        fmt::format("\n\"on / this\" is the time of everything on over that of the row; for \"{}\", that of "
                    "one run.{}\n",
                    row_program, result.quick ? " What is to be reached is meant for the whole set." : "");
    return text;
}

} // namespace measure
