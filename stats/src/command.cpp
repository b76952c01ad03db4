// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stats/command.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <stats/analysis.h>
#include <stats/exports.h>
#include <support/error.h>
#include <support/number_range.h>

#include "figure8.h"
#include "findings.h"
#include "forest.h"
#include "labels.h"
#include "outcome.h"
#include "output.h"
#include "power_report.h"
#include "report.h"
#include "summary.h"
#include "table_text.h"
#include "verdicts.h"

namespace stats {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_seed = (std::uint64_t{1} << 53) - 1; ///< that JSON keeps exactly
constexpr const char* power_group = "With --power";

constexpr const char* footer = R"(DESCRIPTION
  Reads the logs STUDY/sub-*/beh/sub-*_task-skin2afc[_run-NN]_beh.tsv and says where the shaders differ, which
  are as good as each other, and how sure that is: Table II of Jimenez, Sundstedt and Gutierrez (2009) - a
  chi-square (df 1) of each condition's answers against half and half; a star marks p > 0.05 - and a table by
  shader.

  Answers of one participant are not independent: the verdicts take the participants as the sample - a sign-flip
  test by Holm's method over all rows of shaders.tsv, two one-sided t-tests within --bounds - and need six of
  them. A t-test and a logistic mixed model stand beside; the answer says where pooled tests disagree.

  Of each participant's runs the last complete one counts or, where none is complete, the last that holds
  trials. Complete is a run with the trials its sidecar plans (TrialsPlanned) or, without one, with as many as
  the longest log. Answers n/a and a last line that was cut off are left out. The report lists what was.

  A log that is not as protocols/FORMAT.md has it, or a run of another protocol, refuses the study, with file and
  line; --skip-bad leaves such files out and lists them.

  Expertise: columns of participants.tsv and phenotype/*.tsv whose names have one of the words expertise, expert,
  experience, experienced, graphics, art, arts, drawing, photography.

  --power plans a study, without logs: the proportion that a design finds, the participants that a proportion
  needs, exactly for independent answers and by simulation for participants who differ.

FILES WRITTEN (in DIR)
  report.html          all of it on one self-contained page
  table2.tsv           one row a condition, with every figure
  shaders.tsv          one row a shader: over all, by distance and azimuth where several
  participants.tsv     how far each participant's answers can be trusted
  summary.json         all numbers, what was used and left out, the answer in sentences
  trials.tsv           one row a trial, for R
  comparisons.csv      the answers as pwcmp reads them
  figure8.svg, forest_shaders.svg, forest_conditions.svg; power.tsv, power.svg with --power

EXIT STATUS
  0  done
  1  it failed (no gnuplot on PATH, a full disk)
  2  bad usage or bad input; nothing was written

EXAMPLE
  skin2afc analyse out/study --out out/analysis --stimuli out/stimuli
  skin2afc analyse --power --participants 24 --trials 24 --proportion 0.6)";

struct Arguments {
    fs::path study, out, stimuli;
    std::vector<double> bounds{EquivalenceBounds{}.low, EquivalenceBounds{}.high};
    Leniency leniency;
    bool power = false;
    PowerPlan plan;
};

/// The shaders over all conditions, in aligned columns.
std::string shaders_text(const Analysis& analysis) {
    std::string text = fmt::format("{:28}{:>10}{:>8}{:>16}{:>11}{:>8}{:>14}{:>10}{:>10}  {}\n",
                                   "Over all conditions", "chosen", "share", "t 95 %", "sign-flip", "Holm",
                                   "equivalence t", "pooled p", "BF01", "verdict");
    for (const GroupRow* group : overall(analysis.groups)) {
        if (!group->figures) {
            continue;
        }
        const Figures& f = *group->figures;
        const ParticipantLevel& level = f.participant;
        text += fmt::format(
            "{:28}{:>10}{:>8.3f}{:>16}{:>11.2g}{:>8.2g}{:>14}{:>10.2g}{:>10.2g}  {}\n",
            fmt::format("{} against {}", shader_label(group->test), shader_label(group->reference)),
            fmt::format("{}/{}", group->tally.reference_chosen, group->tally.n), f.proportion,
            level.mean ? fmt::format("{:.3f} to {:.3f}", level.mean->ci.low, level.mean->ci.high) : "n/a",
            level.sign_flip.p, level.p_holm,
            level.p_equivalence ? fmt::format("{:.2g}", *level.p_equivalence) : "n/a", f.chi_square.p,
            std::exp(f.log_bf01), verdict_words(*group, analysis.settings.bounds));
    }
    text += "  (t, sign-flip, Holm - over all rows of shaders.tsv - and equivalence t: participants as the "
            "sample; "
            "pooled p and BF01: as if all answers were independent)\n";
    return text;
}

/// The result on the terminal.
void print_result(const Analysis& analysis) {
    const Study& study = analysis.study;
    const Contents found = contents(study);
    const std::string notice = simulated_notice(study);
    if (!notice.empty()) {
        fmt::print("{}\n\n", notice);
    }
    fmt::print("{}: {}, {}\n\n", support::one_line(study.name), participants_text(found.participants),
               counted(found.trials - found.unanswered, "answer"));
    for (const Verdict& verdict : verdicts(analysis)) {
        fmt::print("{}\n", verdict.headline);
    }
    fmt::print("\n{}\n", table2_text(paper_grid(analysis.rows), ::isatty(STDOUT_FILENO) == 1));
    fmt::print("{}\n", shaders_text(analysis));
    for (const auto& sentences :
         {disagreements(analysis), participant_findings(analysis.rows), findings(analysis.rows)}) {
        for (const std::string& sentence : sentences) {
            fmt::print("{}\n", sentence);
        }
    }
    fmt::print("{}\n", order_sentence(analysis));
    for (const ExpertiseComparison& comparison : analysis.expertise) {
        fmt::print("Expertise {}\n", support::one_line(expertise_sentence(comparison)));
    }
    for (const std::string& note : quality_notes(study, analysis.participants)) {
        fmt::print("{}\n", note);
    }

    std::size_t runs_left_out = 0, lines_set_aside = 0;
    for (const Run& run : study.runs) {
        runs_left_out += run.used ? 0 : 1;
        lines_set_aside += run.log.torn ? 1 : 0;
    }
    if (runs_left_out + lines_set_aside + found.unanswered + study.bad_files.size() > 0) {
        fmt::print(
            "Left out, see the report: runs {}, bad files {}, torn lines {}, trials without an answer {}.\n",
            runs_left_out, study.bad_files.size(), lines_set_aside, found.unanswered);
    }
}

/// The pictures to show: of --stimuli, which must have some, or what the study keeps.
std::vector<std::optional<ConditionPictures>> pictures_of(const Analysis& analysis,
                                                          const Arguments& arguments) {
    if (arguments.stimuli.empty()) {
        return condition_pictures(analysis.rows, kept_stimuli(analysis.study, arguments.study));
    }
    auto pictures = condition_pictures(analysis.rows, std::span(&arguments.stimuli, 1));
    if (std::none_of(pictures.begin(), pictures.end(), [](const auto& one) { return one.has_value(); })) {
        throw support::input_error("--stimuli: {}: expected pictures of the study's conditions, "
                                   "<shader>_<distance>_<azimuth>.png, found none of any condition's two",
                                   arguments.stimuli.string());
    }
    return pictures;
}

void analyse(const Arguments& arguments) {
    // Make everything before anything is written.
    const Settings settings{{arguments.bounds[0], arguments.bounds[1]}, arguments.plan.seed};
    const Analysis analysis = analyse_study(arguments.study, settings, arguments.leniency);
    const bool simulated = is_simulated(analysis.study);
    const std::string notice = simulated_notice(analysis.study);
    const ReportFigures figures{figure8(analysis.rows, notice), forest_of_shaders(analysis, notice),
                                forest_of_conditions(analysis, notice), pictures_of(analysis, arguments),
                                read_png(arguments.study / "stimuli" / "contact_sheet.png")};
    write_together(arguments.out, {{"table2.tsv", to_tsv(analysis.rows, simulated)},
                                   {"shaders.tsv", to_tsv(analysis.groups, simulated)},
                                   {"participants.tsv", to_tsv(analysis.participants, simulated)},
                                   {"summary.json", summary_json(analysis)},
                                   {"trials.tsv", trials_tsv(analysis.study)},
                                   {"comparisons.csv", comparisons_csv(analysis.study)},
                                   {"figure8.svg", figures.figure8},
                                   {"forest_shaders.svg", figures.shaders},
                                   {"forest_conditions.svg", figures.conditions},
                                   {"report.html", report_html(analysis, figures)}});
    print_result(analysis);
    fmt::print(
        "\nWritten to {}: report.html, table2.tsv, shaders.tsv, participants.tsv, summary.json, trials.tsv, "
        "comparisons.csv and three figures\n",
        support::one_line(arguments.out.string()));
}

void plan_study(const Arguments& arguments) {
    const PowerReport report = power_report(arguments.plan);
    if (!arguments.out.empty()) {
        write_together(arguments.out, {{"power.tsv", report.tsv}, {"power.svg", report.svg}});
    }
    fmt::print("{}", report.text);
    if (!arguments.out.empty()) {
        fmt::print("\nWritten to {}: power.tsv, power.svg\n", support::one_line(arguments.out.string()));
    }
}

/// Refuse options that would be ignored.
void check_options(const CLI::App& command, bool power) {
    if (power) {
        for (const char* name : {"STUDY", "--stimuli", "--bounds", "--skip-bad", "--mixed-protocols"}) {
            if (command.count(name) > 0) {
                throw support::input_error("{}: expected not to be given with --power, which reads no logs",
                                           name);
            }
        }
        return;
    }
    for (const CLI::Option* option :
         command.get_options([](const CLI::Option* one) { return one->get_group() == power_group; })) {
        if (option->count() > 0) {
            throw support::input_error("{}: expected with --power only, found without it",
                                       option->get_name());
        }
    }
}

void run(const Arguments& arguments) {
    if (arguments.power) {
        plan_study(arguments);
        return;
    }
    for (const auto& [name, value] : {std::pair("STUDY", arguments.study), {"--out", arguments.out}}) {
        if (value.empty()) {
            throw CLI::RequiredError(name);
        }
    }
    if (!(arguments.bounds[0] < 0.5 && 0.5 < arguments.bounds[1])) {
        throw support::input_error("--bounds: expected LOW below 0.5 and HIGH above it, found {} and {}",
                                   arguments.bounds[0], arguments.bounds[1]);
    }
    if (std::error_code ignored;
        !arguments.stimuli.empty() && !fs::is_directory(arguments.stimuli, ignored)) {
        throw support::input_error("--stimuli: {}: expected a folder of stimuli, found {}",
                                   arguments.stimuli.string(),
                                   fs::exists(arguments.stimuli, ignored) ? "a file" : "nothing");
    }
    analyse(arguments);
}

void add_power_options(CLI::App& command, PowerPlan& plan) {
    command.add_option("--participants", plan.participants, "Participants of the design")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str()
        ->group(power_group);
    command.add_option("--trials", plan.trials, "Trials of each participant on the question that is tested")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str()
        ->group(power_group);
    command
        .add_option("--proportion", plan.proportion, "Proportion choosing the reference that is to be found")
        ->check(support::number_range(0.5, 1))
        ->capture_default_str()
        ->group(power_group);
    command
        .add_option("--spread", plan.spreads, "Standard deviations between participants, on the logit scale")
        ->check(support::number_range(0, 5))
        ->expected(1, 4)
        ->delimiter(',')
        ->capture_default_str()
        ->group(power_group);
    command.add_option("--studies", plan.studies, "Simulated studies for each figure")
        ->check(CLI::Range(100, 1000000))
        ->capture_default_str()
        ->group(power_group);
}

} // namespace

void add_command(CLI::App& app) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("analyse", "Analyse a study's logs: Table II, Figure 8, participants, a report");
    command->add_option("STUDY", arguments->study,
                        "The study's folder (BIDS), as skin2afc session writes it");
    command->add_option("--out", arguments->out, "Folder for the results; made if missing")->type_name("DIR");
    command
        ->add_option("--stimuli", arguments->stimuli,
                     "Folder of the stimuli, to show them; default: the study's copies")
        ->type_name("DIR");
    command
        ->add_option("--bounds", arguments->bounds, "Proportions between which shaders count as equally good")
        ->expected(2)
        ->delimiter(',')
        ->check(support::number_range(0.001, 0.999))
        ->capture_default_str()
        ->type_name("LOW,HIGH");
    command->add_option("--seed", arguments->plan.seed, "Seed of whatever is drawn at random")
        ->check(CLI::Range(std::uint64_t{0}, largest_seed))
        ->capture_default_str();
    command->add_flag("--skip-bad", arguments->leniency.skip_bad, "Leave bad files out and list them");
    command->add_flag("--mixed-protocols", arguments->leniency.mixed_protocols,
                      "Take runs of different protocol files together");
    command->add_flag("--power", arguments->power, "Plan a study: power, without logs");
    add_power_options(*command, arguments->plan);
    command->footer(footer);
    command->callback([arguments, command] {
        check_options(*command, arguments->power);
        run(*arguments);
    });
}

} // namespace stats
