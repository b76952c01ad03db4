// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report_sections.h"

#include <cmath>

#include <boost/version.hpp>
#include <fmt/format.h>

#include "findings.h"
#include "html.h"
#include "labels.h"
#include "outcome.h"
#include "verdicts.h"

namespace stats {
namespace {

std::string left_out_html(const Study& study) {
    std::vector<std::string> items;
    if (const Contents found = contents(study); found.unanswered > 0) {
        items.push_back(
            fmt::format("{} of {} trials without an answer (n/a)", found.unanswered, found.trials));
    }
    for (const BadFile& bad : study.bad_files) {
        items.push_back(fmt::format("{}: bad file, left out on request: {}", bad.file, bad.why));
    }
    for (const Run& run : study.runs) {
        if (!run.used) {
            items.push_back(fmt::format("{}: not counted: {}", run.file, run.why_left_out));
        } else if (!run.complete) {
            items.push_back(fmt::format("{}: counted though incomplete: {} of {} trials", run.file,
                                        run.log.trials.size(), run.trials_expected));
        }
        if (run.log.torn) {
            items.push_back(
                fmt::format("{}: line {} set aside: {}", run.file, run.log.torn->line, run.log.torn->why));
        }
    }
    for (const std::string& participant : study.participants_without_log) {
        items.push_back(fmt::format("sub-{}: no log", participant));
    }
    return items.empty() ? paragraph("Nothing: every run is complete and every trial has an answer.")
                         : list_of(items);
}

/// The run of each participant that counts, and what is notable of it.
std::string participants_table(const Analysis& analysis) {
    HtmlTable table("details", {"Participant", "Run that counts", "Trials", "Missing", "Under 300 ms",
                                "First interval", "Median time", "Dropped frames", "Reference chosen"});
    for (const ParticipantQuality& one : analysis.participants) {
        const auto mark = [](std::size_t count) {
            return count > 0 ? fmt::format("<span class=\"alike\">{}</span>", count) : std::string("0");
        };
        const std::string first = fmt::format("{} of {}", one.order.first_chosen(), one.order.n());
        table.add({html_text("sub-" + one.participant), html_text(one.file.substr(one.file.rfind('/') + 1)),
                   fmt::format("{}{}", one.trials, one.complete ? "" : " (incomplete)"), mark(one.missing),
                   mark(one.fast),
                   one.always_same_interval() || one.favours_interval()
                       ? "<span class=\"alike\">" + first + "</span>"
                       : first,
                   std::isnan(one.median_response_time_s)
                       ? "n/a"
                       : fmt::format("{:.2f} s", one.median_response_time_s),
                   one.dropped_frames ? fmt::format("{}", *one.dropped_frames) : "n/a",
                   fmt::format("{} of {}", one.answers() - one.errors, one.answers())});
    }
    return table.html();
}

} // namespace

std::string expertise_html(const Analysis& analysis) {
    if (analysis.expertise.empty()) {
        return paragraph("The study's participants.tsv and phenotype/*.tsv hold no question on expertise.");
    }
    std::string html;
    HtmlTable table("details", {"Question", "With: participants", "Errors", "Median share",
                                "Without: participants", "Errors", "Median share", "Rank-sum p", "Welch p"});
    for (const ExpertiseComparison& c : analysis.expertise) {
        html += paragraph(expertise_sentence(c));
        std::vector<std::string> cells{html_text(fmt::format("{} ({})", c.column, c.file))};
        for (const GroupErrors& group : {c.with, c.without}) {
            cells.push_back(fmt::format("{}", group.participants));
            cells.push_back(fmt::format("{} of {}", group.errors, group.answers));
            cells.push_back(group.participants > 0 ? fmt::format("{:.3f}", group.median) : "n/a");
        }
        cells.push_back(c.rank_sum
                            ? fmt::format("{:.3g}{}", c.rank_sum->p, c.rank_sum->exact ? "" : " (normal)")
                            : "n/a");
        cells.push_back(c.welch ? fmt::format("{:.3g}", c.welch->p) : "n/a");
        table.add(cells);
    }
    return html + table.html() +
           paragraph("An error is an answer for the shader that is not the reference; tests compare the "
                     "participants' "
                     "shares of errors.",
                     "note");
}

std::string quality_html(const Analysis& analysis) {
    const auto notes = quality_notes(analysis.study, analysis.participants);
    return (notes.empty()
                ? paragraph("No answer under 300 ms, no participant who favours an interval, no dropped "
                            "frame on record.")
                : list_of(notes)) +
           "<h3>What was left out</h3>\n" + left_out_html(analysis.study) + "<h3>Participants</h3>\n" +
           participants_table(analysis);
}

std::string methods_html(const Analysis& analysis) {
    const Contents found = contents(analysis.study);
    const EquivalenceBounds& bounds = analysis.settings.bounds;
    bool drawn = false;
    for (const auto& row : analysis.groups) {
        drawn |= row.figures && !row.figures->participant.sign_flip.exact;
    }
    std::string html = paragraph(fmt::format(
        "{} gave {} in {}{}. Of each participant's "
        "runs the last complete one counts or, where none is complete, the last that "
        "holds trials; trials without an "
        "answer were left out.",
        participants_text(found.participants),
        counted(found.trials - found.unanswered, "two-alternative forced-choice answer"),
        counted(analysis.rows.size(), "condition"), is_simulated(analysis.study) ? " (simulated data)" : ""));
    html += paragraph(fmt::format(
        "In each condition, and for each shader over all conditions, by distance and by azimuth where there "
        "are several, the numbers of "
        "answers that chose the reference and the other shader were compared with half and half by a "
        "one-sample "
        "chi-square test (df = 1, no continuity correction, alpha = {}), as by Jimenez, Sundstedt and "
        "Gutierrez "
        "(2009), and by the exact two-sided binomial test (outcomes no more probable than the observed one). "
        "Pooled proportions are given with Wilson score and Clopper\u2013Pearson exact 95 % intervals, "
        "effect sizes "
        "as "
        "Cohen's g = |p - 1/2|. P-values of the chi-square and the sign-flip tests were corrected by Holm's "
        "method, "
        "those of the chi-square tests also by Benjamini and Hochberg's, within two families: {}, "
        "and {} of the shaders' table.",
        alpha, all_counted(significance(analysis.rows).tests, "condition"),
        all_counted(analysis.groups.size(), "row")));
    html += paragraph(fmt::format(
        "Answers of one participant are not independent. Taking participants as the sample, each "
        "participant's "
        "surplus of answers for the reference was tested by a two-sided sign-flip (randomisation) test over "
        "all sign "
        "patterns{}, with a t-test of the participants' proportions against 1/2 as a check, and by a "
        "logistic mixed "
        "model with a random intercept for each participant (maximum likelihood, adaptive Gauss\u2013Hermite "
        "quadrature with {} points, for participants who always answered the same the trapezoidal rule; Wald "
        "test with the standard error from the observed information, which "
        "holds for many participants: with ten it is significant in 8 to 9 % of studies without a "
        "difference). "
        "Heterogeneity "
        "between participants was tested by the likelihood ratio against an equal mixture of chi-square with "
        "0 and 1 "
        "degrees of freedom.",
        drawn
            ? fmt::format(" (exact where up to 10^8 additions suffice, else {} random patterns, seed {}; the "
                          "standard error of p is in the tables)",
                          SignFlipLimits{}.draws, analysis.settings.seed)
            : " (exact)",
        quadrature_points));
    html += paragraph(fmt::format("No significant difference does not show that two shaders look equally "
                                  "good. Equivalence was tested over "
                                  "participants by two one-sided t-tests of their mean proportion, whose 95 "
                                  "% interval is Student's t, and "
                                  "beside by two one-sided exact binomial tests of all answers, with bounds "
                                  "of {} and {} for the proportion "
                                  "choosing the reference. The Bayes factor BF01 compares a proportion of "
                                  "exactly 1/2 with a uniform prior, "
                                  "Beta(1, 1), on the proportion.",
                                  bounds.low, bounds.high));
    html += paragraph(fmt::format("The verdicts take the participants as the sample: a shader differs where "
                                  "the sign-flip p, by Holm's method "
                                  "over all rows of the shaders' table, is at most {0}; it is as good where "
                                  "it does not differ and both "
                                  "one-sided t-tests are significant, on average only where a distance, an "
                                  "azimuth or a condition differs "
                                  "beyond the bounds or a distance or azimuth is not within them by itself. "
                                  "Below {1} participants no sign-flip "
                                  "test reaches {0}, and nothing is decided; nor by a p drawn at random "
                                  "within three of its standard errors of "
                                  "{0}.",
                                  alpha, fewest_participants(1)));
    bool normal = false;
    for (const ExpertiseComparison& comparison : analysis.expertise) {
        normal |= comparison.rank_sum && !comparison.rank_sum->exact;
    }
    html += paragraph(fmt::format(
        "Bias to an interval was tested with the participants as the sample: within each condition that a "
        "participant answered in both orders, the surplus of the reference where it came first over where it "
        "came "
        "second, summed, went into the sign-flip test, so that a preference does not look like a bias; the "
        "pooled "
        "exact binomial test of first against second interval stands beside. Single participants' answers "
        "were "
        "tested for the order by Fisher's exact test. Sensitivity is d' = sqrt(2) z(Pc) from the proportion "
        "Pc "
        "choosing the reference, and d' = (z(H) - z(F)) / sqrt(2) freed from that bias, H and F being the "
        "proportions "
        "choosing the first interval where it showed the reference and where it did not. Response times are "
        "medians "
        "with quartiles. Participants with and without expertise were compared in their shares of errors by "
        "the {} "
        "rank-sum test with mid-ranks, and by Welch's t-test.",
        normal ? "exact (normal approximation where the splits are too many)" : "exact"));
    html += paragraph(fmt::format("Computed with skin2afc {} (Boost.Math {}.{}).", SKIN2AFC_VERSION,
                                  BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000));
    return html;
}

std::string stimuli_html(const Analysis& analysis,
                         const std::vector<std::optional<ConditionPictures>>& pictures,
                         const std::optional<std::string>& contact_sheet) {
    std::string cards;
    const Condition* previous = nullptr;
    for (std::size_t i = 0; i < analysis.rows.size(); ++i) {
        const auto& [c, tally, figures] = analysis.rows[i];
        if (!pictures[i]) {
            continue;
        }
        const auto figure = [](const std::string& png, const std::string& caption) {
            return fmt::format("<figure class=\"thumb\">{}<figcaption>{}</figcaption></figure>",
                               image(png, caption), html_text(caption));
        };
        // A line of cards a configuration, led by the reference.
        if (previous == nullptr || previous->reference != c.reference || previous->distance != c.distance ||
            previous->azimuth_deg != c.azimuth_deg) {
            cards += fmt::format(
                "{}<div class=\"cards\">{}", previous == nullptr ? "" : "</div>\n",
                figure(pictures[i]->reference, configuration_label(c.reference, c.distance, c.azimuth_deg)));
        }
        previous = &c;
        const std::string numbers =
            figures ? fmt::format("{} of {} chose {}, p {}", tally.reference_chosen, tally.n,
                                  shader_label(c.reference), p_phrase(figures->chi_square.p))
                    : "no answers";
        cards += fmt::format(
            "<div class=\"pair{}\">{}{}</div>", figures && figures->chi_square.p > alpha ? " same" : "",
            figure(pictures[i]->test, shader_label(c.test)), figure(pictures[i]->difference, numbers));
    }
    if (!cards.empty()) {
        return paragraph(
                   fmt::format(
                       "Each configuration's reference, then each test shader with its absolute difference "
                       "from the reference (display signal times {}). Framed: no significant difference.",
                       difference_gain),
                   "note") +
               cards + "</div>\n";
    }
    if (contact_sheet) {
        return fmt::format(
            "<figure><div class=\"card\">{}</div><figcaption>Contact sheet of the study's stimuli. With "
            "--stimuli DIR, the report shows them beside their numbers.</figcaption></figure>\n",
            image(*contact_sheet, "Contact sheet of the stimuli"));
    }
    return paragraph("The study's folder holds no pictures of the stimuli and no stimuli/contact_sheet.png, "
                     "so they are not "
                     "shown here; --stimuli DIR names their folder.");
}

} // namespace stats
