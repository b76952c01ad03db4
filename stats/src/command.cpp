// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/command.h>

#include <cstdio>
#include <fstream>
#include <list>
#include <map>
#include <memory>
#include <string>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <stats/study.h>
#include <stats/table.h>
#include <support/error.h>
#include <support/file.h>

#include "figure8.h"
#include "findings.h"
#include "report.h"
#include "summary.h"
#include "table_text.h"

namespace stats {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer = R"(DESCRIPTION
  Reads the logs STUDY/sub-*/beh/sub-*_task-skin2afc[_run-NN]_beh.tsv, tests in each condition whether the
  answers differ from half and half (one-sample chi-square, df 1), and prints the result as a table:
  configurations down, test shaders across. Conditions without a significant difference (p > 0.05) carry a
  star.

  Of each participant's runs the last complete one counts or, where none is complete, the last that holds
  trials. Complete is a run with the trials its sidecar (.json beside the log, field TrialsPlanned) plans or,
  without one, with as many as the longest log. Answers n/a are left out; a last line that was cut off is set
  aside. The report lists what was left out. Analyses of simulated data say so.

FILES WRITTEN
  DIR/table2.tsv    one row a condition: counts, proportion, chi-square, its p, exact binomial p, p after
                    Holm, q after Benjamini and Hochberg, Wilson 95 % interval; numbers read back exactly
  DIR/summary.json  runs and lines used and left out, findings, and the table
  DIR/figure8.svg   proportion choosing the reference by azimuth and by distance, drawn by gnuplot
  DIR/report.html   all of it on one self-contained page, with STUDY/stimuli/contact_sheet.png if it is there

EXIT STATUS
  0  done
  1  it failed (no gnuplot on PATH, a full disk)
  2  bad usage or bad input; nothing was written

EXAMPLE
  skin2afc analyse out/study --out out/analysis)";

struct Arguments {
    fs::path study, out;
};

/// Write all files beside their places before the first is put in place, so that a full disk changes none.
void write_together(const fs::path& folder, const std::map<std::string, std::string>& contents_by_name) {
    support::make_writable_folder(folder);
    std::list<support::PendingFile> pending;
    for (const auto& [name, content] : contents_by_name) {
        support::PendingFile& file = pending.emplace_back(folder / name);
        std::ofstream stream(file.path(), std::ios::binary);
        stream.write(content.data(), static_cast<std::streamsize>(content.size()));
        stream.close();
        if (!stream) {
            throw support::failure("{}: cannot be written", (folder / name).string());
        }
    }
    for (support::PendingFile& file : pending) {
        file.commit();
    }
}

/// The result on the terminal.
void print_result(const Study& study, std::span<const Row> rows) {
    const Contents found = contents(study);
    const std::string notice = simulated_notice(study);
    if (!notice.empty()) {
        fmt::print("{}\n\n", notice);
    }
    fmt::print("{}: {} participants, {} answers\n\n", support::one_line(study.name), found.participants,
               found.trials - found.unanswered);
    fmt::print("{}\n", table2_text(paper_grid(rows), ::isatty(STDOUT_FILENO) == 1));
    for (const std::string& sentence : findings(rows)) {
        fmt::print("{}\n", sentence);
    }

    std::size_t runs_left_out = 0, lines_set_aside = 0;
    for (const Run& run : study.runs) {
        runs_left_out += run.used ? 0 : 1;
        lines_set_aside += run.log.torn ? 1 : 0;
    }
    if (runs_left_out + lines_set_aside + found.unanswered > 0) {
        fmt::print("Left out, see the report: runs {}, torn lines {}, trials without an answer {}.\n",
                   runs_left_out, lines_set_aside, found.unanswered);
    }
}

void analyse(const Arguments& arguments) {
    // Make everything before anything is written.
    const Study study = read_study(arguments.study);
    const std::vector<Row> rows = make_table(study);
    const auto contact_sheet = read_png(arguments.study / "stimuli" / "contact_sheet.png");
    const std::string figure = figure8(rows, simulated_notice(study));
    write_together(arguments.out, {{"table2.tsv", to_tsv(rows, is_simulated(study))},
                                   {"summary.json", summary_json(study, rows)},
                                   {"figure8.svg", figure},
                                   {"report.html", report_html(study, rows, figure, contact_sheet)}});
    print_result(study, rows);
    fmt::print("\nWritten to {}: table2.tsv, figure8.svg, summary.json, report.html\n",
               support::one_line(arguments.out.string()));
}

} // namespace

void add_command(CLI::App& app) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("analyse", "Analyse a study's logs: Table II, Figure 8, a report");
    command->add_option("STUDY", arguments->study, "The study's folder (BIDS), as skin2afc session writes it")
        ->required();
    command->add_option("--out", arguments->out, "Folder for the results; made if missing")
        ->required()
        ->type_name("DIR");
    command->footer(footer);
    command->callback([arguments] { analyse(*arguments); });
}

} // namespace stats
