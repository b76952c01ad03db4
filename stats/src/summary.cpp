// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "summary.h"

#include <nlohmann/json.hpp>

#include "findings.h"

namespace stats {
namespace {

using nlohmann::ordered_json;

// Raised whenever a formula changes in a way that changes a number.
constexpr int formulas_version = 1;

ordered_json row_json(const Row& row) {
    const Condition& c = row.condition;
    ordered_json entry{{"reference", c.reference}, {"test", c.test},
                       {"distance", c.distance},   {"azimuth_deg", c.azimuth_deg},
                       {"n", row.tally.n},         {"reference_chosen", row.tally.reference_chosen}};
    if (row.figures) {
        const Figures& f = *row.figures;
        entry.update(ordered_json{{"proportion", f.proportion},
                                  {"chi_square", f.chi_square.statistic},
                                  {"df", f.chi_square.df},
                                  {"p_chi_square", f.chi_square.p},
                                  {"p_exact", f.p_exact},
                                  {"p_holm", f.p_holm},
                                  {"q_bh", f.q_bh},
                                  {"ci_low", f.ci.low},
                                  {"ci_high", f.ci.high}});
    }
    return entry;
}

/// The runs that count or were left out, and the lines set aside in those that count.
void add_runs(ordered_json& summary, const Study& study) {
    auto used = ordered_json::array(), left_out = ordered_json::array(), set_aside = ordered_json::array();
    auto participants = ordered_json::array();
    for (const Run& run : study.runs) {
        const std::size_t trials = run.log.trials.size();
        if (run.used) {
            participants.push_back(run.participant);
            used.push_back({{"file", run.file}, {"trials", trials}, {"complete", run.complete}});
        } else {
            left_out.push_back({{"file", run.file}, {"trials", trials}, {"why", run.why_left_out}});
        }
        if (run.log.torn) {
            set_aside.push_back(
                {{"file", run.file}, {"line", run.log.torn->line}, {"why", run.log.torn->why}});
        }
    }
    summary["participants"] = std::move(participants);
    summary["participants_without_log"] = study.participants_without_log;
    summary["runs_used"] = std::move(used);
    summary["runs_left_out"] = std::move(left_out);
    summary["lines_set_aside"] = std::move(set_aside);
}

} // namespace

std::string summary_json(const Study& study, std::span<const Row> rows) {
    const Contents found = contents(study);
    ordered_json summary{
        {"study", study.name}, {"simulated", is_simulated(study)}, {"simulated_runs", found.simulated_runs}};
    add_runs(summary, study);
    summary["trials"] = found.trials;
    summary["unanswered"] = found.unanswered;

    const Significance count = significance(rows);
    summary["alpha"] = alpha;
    summary["tests"] = count.tests;
    summary["significant"] = {{"raw", count.raw}, {"holm", count.holm}, {"benjamini_hochberg", count.bh}};
    summary["findings"] = findings(rows);
    summary["formulas"] = {
        {"version", formulas_version},
        {"chi_square", "one-sample, against half and half, df 1, no continuity correction"},
        {"p_exact", "two-sided binomial, outcomes no more probable than the observed one"},
        {"p_holm", "Holm 1979, over all rows tested"},
        {"q_bh", "Benjamini and Hochberg 1995, over all rows tested"},
        {"ci", "Wilson 1927, 95 %"}};
    auto conditions = ordered_json::array();
    for (const Row& row : rows) {
        conditions.push_back(row_json(row));
    }
    summary["conditions"] = std::move(conditions);
    return summary.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

} // namespace stats
