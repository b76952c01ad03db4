// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "power_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <stats/power.h>

#include "labels.h"
#include "outcome.h"
#include "plot.h"

namespace stats {
namespace {

constexpr std::array proportions{0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9};
constexpr std::array<std::int64_t, 10> curve_participants{4, 6, 8, 12, 16, 24, 32, 48, 64, 96};

/// One simulated design and its power.
struct Simulated {
    Design design;
    SimulatedPower power;
};

Simulated simulate(const PowerPlan& plan, std::int64_t participants, double proportion, double spread) {
    const Design design{participants, plan.trials, proportion, spread};
    return {design, simulated_power(design, plan.level, plan.studies, plan.seed)};
}

/// Exact figures, for answers that are independent.
std::string exact_text(const PowerPlan& plan) {
    const std::int64_t n = plan.participants * plan.trials;
    const double least = detectable_proportion(n, plan.power, plan.level);
    std::string text =
        fmt::format("Exact, for independent answers (two-sided binomial test, level {}):\n  {} participants "
                    "x {} = {} answers find {} with a power of {}\n\n  {:>10}  {:>14}  {:>12}  {:>16}\n",
                    plan.level, plan.participants, counted(static_cast<std::size_t>(plan.trials), "trial"), n,
                    std::isnan(least) ? "no proportion" : fmt::format("a proportion of {:.3f}", least),
                    plan.power, "proportion", "power of these", "answers for", "participants for");
    const auto fewest = static_cast<std::int64_t>(fewest_participants(1));
    for (const double proportion : proportions) {
        const std::int64_t needed = trials_needed(proportion, plan.power, plan.level);
        fmt::format_to(std::back_inserter(text), "  {:>10}  {:>14.3f}  {:>12}  {:>16}\n", proportion,
                       exact_power(n, proportion, plan.level), needed,
                       std::max(fewest, (needed + plan.trials - 1) / plan.trials));
    }
    return text +
           fmt::format("  (answers and participants for a power of {}, at every larger number, too; at least "
                       "{} participants, as fewer\n  cannot be significant in the sign-flip test; those who "
                       "differ need more: see below)\n",
                       plan.power, fewest);
}

/// The smallest number of participants in simulations with the power, by halving; 0: more than the most
/// tried.
std::int64_t participants_needed(const PowerPlan& plan, double spread) {
    constexpr std::int64_t most = 256;
    const auto enough = [&](std::int64_t participants) {
        return simulate(plan, participants, plan.proportion, spread).power.participant_level >= plan.power;
    };
    if (!enough(most)) {
        return 0;
    }
    std::int64_t low = 1, high = most;
    while (high - low > 1) {
        const std::int64_t middle = (low + high) / 2;
        (enough(middle) ? high : low) = middle;
    }
    return high;
}

std::string simulated_text(const PowerPlan& plan) {
    std::string text = fmt::format(
        "Simulated, for participants who differ ({} studies each, seed {}; {} participants x {}):\n\n"
        "  {:>6}  {:>10}  {:>26}  {:>18}\n",
        plan.studies, plan.seed, plan.participants, counted(static_cast<std::size_t>(plan.trials), "trial"),
        "spread", "proportion", "power, sign-flip test", "pooled chi-square");
    for (const double spread : plan.spreads) {
        for (const double proportion : {0.5, plan.proportion}) {
            const SimulatedPower power = simulate(plan, plan.participants, proportion, spread).power;
            fmt::format_to(std::back_inserter(text), "  {:>6}  {:>10}  {:>18.3f} +- {:.3f}  {:>18.3f}{}\n",
                           spread, proportion, power.participant_level, power.standard_error, power.pooled,
                           proportion == 0.5 ? "  false alarms" : "");
        }
    }
    text += fmt::format(
        "\nParticipants for a power of {} at a proportion of {} (sign-flip test, by simulation):\n",
        plan.power, plan.proportion);
    for (const double spread : plan.spreads) {
        const std::int64_t needed = participants_needed(plan, spread);
        text += fmt::format("  spread {}: {}\n", spread,
                            needed == 0 ? std::string("more than 256") : fmt::format("about {}", needed));
    }
    return text +
           "  (spread: standard deviation between participants of the logit of choosing the reference)\n";
}

std::string curve(const PowerPlan& plan, const std::vector<Simulated>& points) {
    std::string script = figure_head(820, 460), plots;
    for (std::size_t s = 0; s < plan.spreads.size(); ++s) {
        script += fmt::format("$spread{} << END\n", s);
        for (const Simulated& point : points) {
            if (point.design.spread == plan.spreads[s]) {
                script += fmt::format("{} {} {}\n", point.design.participants, point.power.participant_level,
                                      point.power.standard_error);
            }
        }
        script += "END\n";
        plots += fmt::format(", $spread{0} using 1:2:3 with yerrorlines linewidth 2 {1} title 'spread {2}'",
                             s, marker_style(s), plan.spreads[s]);
    }
    script += fmt::format(
        "set border 3 linecolor '#333333'\nset tics nomirror out scale 0.6\nset grid linecolor '#e2e2e2' "
        "linetype 1\nset yrange [0:1.02]\nset xrange [0:*]\nset bars 0.5\nset key bottom right Left "
        "reverse\nset title 'Power of the sign-flip test: proportion {}, {} trials a participant'\n"
        "set xlabel 'Participants'\nset ylabel 'Power'\nplot {} {} title 'power {}'{}\n",
        plan.proportion, plan.trials, plan.power, no_preference_style, plan.power, plots);
    return drawn(script, "Power against participants");
}

} // namespace

PowerReport power_report(const PowerPlan& plan) {
    PowerReport report;
    report.text = exact_text(plan) + "\n" + simulated_text(plan);

    // The curve: power against participants, a line each spread.
    std::vector<Simulated> points;
    report.tsv = "participants\ttrials\tproportion\tspread\tpower\tpower_error\tpower_pooled\tpower_exact\n";
    for (const double spread : plan.spreads) {
        for (const std::int64_t participants : curve_participants) {
            points.push_back(simulate(plan, participants, plan.proportion, spread));
            const auto& [design, power] = points.back();
            report.tsv += fmt::format(
                "{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", participants, plan.trials, plan.proportion, spread,
                exact(power.participant_level), exact(power.standard_error), exact(power.pooled),
                exact(exact_power(participants * plan.trials, plan.proportion, plan.level)));
        }
    }
    report.svg = curve(plan, points);
    return report;
}

} // namespace stats
