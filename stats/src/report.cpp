// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report.h"

#include <fmt/format.h>

#include "findings.h"
#include "labels.h"
#include "outcome.h"
#include "plot.h"
#include "report_sections.h"
#include "report_style.h"
#include "verdicts.h"

namespace stats {
namespace {

/// A figure within the page: without its XML declaration, its ids its own.
std::string inline_svg(const std::string& svg, const std::string& own) {
    std::string text = svg.substr(svg.find("<svg"));
    for (const std::string id :
         {"gpPt", "gpDot", "gpBackground", "gnuplot_", "gnuplot_canvas", "greybox", "fillPat"}) {
        replace_all(text, "id=\"" + id, "id=\"" + own + id);
        replace_all(text, "id='" + id, "id='" + own + id);
        replace_all(text, "#" + id, "#" + own + id);
    }
    return text;
}

std::string figure(const std::string& svg, const std::string& own, const std::string& notice,
                   const std::string& caption) {
    return fmt::format("<figure><div class=\"card\">{}</div>\n<figcaption>{}{}</figcaption></figure>\n",
                       inline_svg(svg, own), notice.empty() ? "" : html_text(notice) + " ", caption);
}

std::string head(const Study& study, const std::string& notice) {
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                    "<title>{}{}: analysis</title>\n<style>{}{}</style>\n</head>\n<body>\n",
                    notice.empty() ? "" : "[simulated] ", html_text(study.name), report_style,
                    notice.empty() ? "" : simulated_page_style);
    if (!notice.empty()) {
        html += fmt::format("<div class=\"banner\" role=\"alert\">{}</div>\n"
                            "<div class=\"watermark\" aria-hidden=\"true\">SIMULATED DATA</div>\n",
                            html_text(notice));
    }
    return html;
}

/// The answer: the verdict on each shader, where the tests disagree, then in which conditions each differs.
std::string answer(const Analysis& analysis) {
    const Contents found = contents(analysis.study);
    std::string html = fmt::format("<main>\n<h1>{}</h1>\n<p class=\"facts\">Two-alternative forced choice: "
                                   "{}, {}, {}.</p>\n",
                                   html_text(analysis.study.name), participants_text(found.participants),
                                   counted(found.trials - found.unanswered, "answer"),
                                   counted(analysis.rows.size(), "condition"));
    html += "<ul class=\"answer\">\n";
    for (const Verdict& verdict : verdicts(analysis)) {
        html += fmt::format("<li><strong>{}</strong> {}</li>\n", html_text(verdict.headline),
                            html_text(verdict.evidence));
    }
    html += "</ul>\n" + list_of(disagreements(analysis), any_shader_disagrees(analysis) ? "warning" : "note");
    return html + "<h3>In which conditions</h3>\n" + list_of(participant_findings(analysis.rows)) +
           "<h3>In which conditions, as the paper tests</h3>\n" +
           paragraph(
               "All answers are pooled as if independent; the participants' table further down does not.",
               "note") +
           list_of(findings(analysis.rows));
}

} // namespace

std::string report_html(const Analysis& analysis, const ReportFigures& figures) {
    const std::string notice = simulated_notice(analysis.study);
    std::string html = head(analysis.study, notice) + answer(analysis);
    html += "<h2>Table II</h2>\n" + table2_html(analysis);
    html +=
        "<h2>Figure 8</h2>\n" +
        figure(figures.figure8, "a", notice,
               "Proportion of answers that chose the reference, by light azimuth (left) and camera distance "
               "(right): 1 is always the reference, 0.5 (dashed) no preference. Bars are pooled Wilson 95 % "
               "intervals, as if all answers were independent: too short where participants differ. The "
               "tables give intervals over participants.");
    html += "<h2>Shaders</h2>\n" +
            figure(figures.shaders, "b", notice,
                   "Filled: the pooled proportion with its Wilson 95 % interval, as if all answers were "
                   "independent. Open: a participant in the "
                   "middle of "
                   "the population, by the mixed model. Shaded: the bounds of equivalence.") +
            shaders_html(analysis);
    html += "<h2>Stimuli</h2>\n" + stimuli_html(analysis, figures.pictures, figures.contact_sheet);
    html += "<h2>Every condition</h2>\n" +
            figure(figures.conditions, "c", notice, "Every condition, as above.") + conditions_html(analysis);
    html += "<h2>Order</h2>\n" + order_html(analysis);
    html += "<h2>Expertise</h2>\n" + expertise_html(analysis);
    html += "<h2>Response times</h2>\n" + response_times_html(analysis);
    html += "<h2>Data quality</h2>\n" + quality_html(analysis);
    html += "<h2>Methods</h2>\n" + methods_html(analysis);
    return html + "</main>\n</body>\n</html>\n";
}

} // namespace stats
