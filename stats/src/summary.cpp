// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "summary.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "findings.h"
#include "verdicts.h"

namespace stats {
namespace {

using nlohmann::ordered_json;

// Raised whenever a formula changes in a way that changes a number.
constexpr int formulas_version = 3;

/// A number; infinities as texts, and null for what is missing, as JSON has neither.
ordered_json number(double value) {
    if (std::isinf(value)) {
        return value > 0 ? "inf" : "-inf";
    }
    return std::isnan(value) ? ordered_json(nullptr) : ordered_json(value);
}

void add_figures(ordered_json& entry, const Tally& tally, const std::optional<Figures>& figures) {
    entry["n"] = tally.n;
    entry["reference_chosen"] = tally.reference_chosen;
    if (figures) {
        for (const auto& [name, value, whole] : named_figures(*figures)) {
            entry[name] = whole ? ordered_json(std::llround(value)) : number(value);
        }
        entry["log_bf01"] = number(figures->log_bf01);
    }
}

ordered_json conditions_json(std::span<const Row> rows) {
    auto all = ordered_json::array();
    for (const auto& [c, tally, figures] : rows) {
        ordered_json entry{{"reference", c.reference},
                           {"test", c.test},
                           {"distance", c.distance},
                           {"azimuth_deg", c.azimuth_deg}};
        add_figures(entry, tally, figures);
        all.push_back(std::move(entry));
    }
    return all;
}

ordered_json groups_json(const Analysis& analysis) {
    auto all = ordered_json::array();
    for (const GroupRow& group : analysis.groups) {
        ordered_json entry{{"reference", group.reference},
                           {"test", group.test},
                           {"group", group.by},
                           {"level", group.level}};
        if (group.figures) {
            entry["verdict"] = verdict_words(group, analysis.settings.bounds);
        }
        add_figures(entry, group.tally, group.figures);
        all.push_back(std::move(entry));
    }
    return all;
}

ordered_json order_json(const Analysis& analysis) {
    const OrderTally all = all_orders(analysis);
    const Sensitivity s = sensitivity(all);
    return {{"n", all.n()},
            {"first_chosen", all.first_chosen()},
            {"p_first", binomial_two_sided_p(all.first_chosen(), all.n())},
            {"d_prime", number(s.d_prime)},
            {"d_prime_order", number(s.d_prime_order)},
            {"order_bias", number(s.bias)},
            {"sentence", order_sentence(analysis)}};
}

ordered_json quality_json(const Analysis& analysis) {
    auto all = ordered_json::array();
    for (const ParticipantQuality& one : analysis.participants) {
        all.push_back(
            {{"participant", one.participant},
             {"file", one.file},
             {"complete", one.complete},
             {"trials", one.trials},
             {"missing", one.missing},
             {"under_300_ms", one.fast},
             {"errors", one.errors},
             {"first_chosen", one.order.first_chosen()},
             {"p_first", one.p_first},
             {"p_order", one.both_orders.n() > 0 ? number(one.p_order) : ordered_json()},
             {"always_same_interval", one.always_same_interval()},
             {"favours_interval", one.favours_interval()},
             {"rt_median", number(one.median_response_time_s)},
             {"dropped_frames", one.dropped_frames ? ordered_json(*one.dropped_frames) : ordered_json()}});
    }
    return all;
}

ordered_json expertise_json(const Analysis& analysis) {
    const auto group = [](const GroupErrors& g) {
        return ordered_json{{"participants", g.participants},
                            {"errors", g.errors},
                            {"answers", g.answers},
                            {"median_share", number(g.median)}};
    };
    auto all = ordered_json::array();
    for (const ExpertiseComparison& c : analysis.expertise) {
        ordered_json entry{
            {"column", c.column}, {"file", c.file}, {"with", group(c.with)}, {"without", group(c.without)}};
        if (c.rank_sum) {
            entry["rank_sum"] = {{"w", c.rank_sum->w}, {"p", c.rank_sum->p}, {"exact", c.rank_sum->exact}};
        }
        if (c.welch) {
            entry["welch"] = {{"t", c.welch->t}, {"df", c.welch->df}, {"p", c.welch->p}};
        }
        all.push_back(std::move(entry));
    }
    return all;
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

std::string summary_json(const Analysis& analysis) {
    const Study& study = analysis.study;
    const Contents found = contents(study);
    ordered_json summary{
        {"study", study.name}, {"simulated", is_simulated(study)}, {"simulated_runs", found.simulated_runs}};
    add_runs(summary, study);
    summary["trials"] = found.trials;
    summary["unanswered"] = found.unanswered;

    const Significance count = significance(analysis.rows);
    summary["alpha"] = alpha;
    summary["tests"] = count.tests;
    summary["significant"] = {{"raw", count.raw}, {"holm", count.holm}, {"benjamini_hochberg", count.bh}};
    summary["findings"] = findings(analysis.rows);
    summary["formulas"] = {
        {"version", formulas_version},
        {"chi_square", "one-sample, against half and half, df 1, no continuity correction"},
        {"p_exact", "two-sided binomial, outcomes no more probable than the observed one"},
        {"p_holm", "Holm 1979 of p_chi_square, over all rows tested"},
        {"p_sign_flip_holm", "Holm 1979 of p_sign_flip, over all rows tested; the verdicts follow it"},
        {"q_bh", "Benjamini and Hochberg 1995 of p_chi_square, over all rows tested"},
        {"ci", "Wilson 1927, 95 %"},
        {"ci_exact", "Clopper and Pearson 1934, 95 %"},
        {"p_equivalence", "two one-sided exact binomial tests"},
        {"p_equivalence_t", "two one-sided t-tests of the participants' proportions"},
        {"bf01", "1/2 against Beta(1, 1)"},
        {"p_sign_flip",
         "over participants, all sign patterns, or seeded draws where p_sign_flip_error is not 0"},
        {"ci_t", "Student's t over the participants' proportions, 95 %, cut to [0, 1]"},
        {"p_first_sign_flip",
         "over participants: surpluses for the first interval within conditions answered in both orders"},
        {"mixed", "logistic, random intercept, adaptive Gauss-Hermite quadrature"}};
    summary["conditions"] = conditions_json(analysis.rows);

    auto answers = ordered_json::array();
    for (const Verdict& verdict : verdicts(analysis)) {
        answers.push_back({{"headline", verdict.headline}, {"evidence", verdict.evidence}});
    }
    summary["verdicts"] = std::move(answers);
    summary["participant_findings"] = participant_findings(analysis.rows);
    summary["disagreements"] = disagreements(analysis);
    summary["settings"] = {{"equivalence_low", analysis.settings.bounds.low},
                           {"equivalence_high", analysis.settings.bounds.high},
                           {"prior", "Beta(1, 1)"},
                           {"quadrature_points", quadrature_points},
                           {"seed", analysis.settings.seed}};
    summary["shaders"] = groups_json(analysis);
    summary["order"] = order_json(analysis);
    summary["expertise"] = expertise_json(analysis);
    summary["quality"] = quality_json(analysis);
    summary["quality_notes"] = quality_notes(study, analysis.participants);
    auto bad = ordered_json::array();
    for (const BadFile& file : study.bad_files) {
        bad.push_back({{"file", file.file}, {"why", file.why}});
    }
    summary["bad_files"] = std::move(bad);
    return summary.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

} // namespace stats
