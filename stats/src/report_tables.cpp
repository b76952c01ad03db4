// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report_sections.h"

#include <cmath>

#include <fmt/format.h>

#include "html.h"
#include "labels.h"
#include "table_text.h"
#include "verdicts.h"

namespace stats {
namespace {

std::string table2_cells(const Row* row, bool with_n) {
    std::string html;
    if (with_n) {
        html = row ? fmt::format("<td>{}</td>", row->tally.n) : "<td>n/a</td>";
    }
    if (row == nullptr || !row->figures) {
        return html + "<td>n/a</td><td>n/a</td>";
    }
    const ChiSquare& chi_square = row->figures->chi_square;
    const bool alike = !significant(*row);
    return html + fmt::format("<td{0}>{1}</td><td{0}>{2}{3}</td>", alike ? " class=\"alike\"" : "",
                              statistic_text(chi_square.statistic), p_text(chi_square.p),
                              alike ? "&nbsp;*" : "");
}

std::string number(double value, int digits) {
    return std::isnan(value) ? "n/a" : fmt::format("{:.{}f}", value, digits);
}

/// A p-value to three digits; one above alpha is marked.
std::string p_cell(double p) {
    const std::string text = std::isnan(p) ? "n/a" : p < 1e-4 ? "&lt; 0.0001" : fmt::format("{:.3g}", p);
    return p > alpha ? fmt::format("<span class=\"alike\">{}</span>", text) : text;
}

std::string interval(const Interval& ci) { return fmt::format("{:.3f} to {:.3f}", ci.low, ci.high); }

std::string bayes(double log_bf01) {
    return std::abs(log_bf01) < 9 ? fmt::format("{:.3g}", std::exp(log_bf01))
           : log_bf01 > 0         ? "&gt; 8000"
                                  : "&lt; 0.0001";
}

const std::vector<std::string>& figure_columns() {
    static const std::vector<std::string> columns{"Reference chosen",
                                                  "Proportion",
                                                  "Wilson 95 %",
                                                  "Exact 95 %",
                                                  "g",
                                                  "p",
                                                  "p exact",
                                                  "Holm",
                                                  "B.\u2013H.",
                                                  "Sign-flip p",
                                                  "Holm",
                                                  "t-test p",
                                                  "Mixed p",
                                                  "SD between",
                                                  "p of SD",
                                                  "Equivalence p",
                                                  "over participants",
                                                  "BF<sub>01</sub>"};
    return columns;
}

/// The cells of figure_columns().
std::vector<std::string> figure_cells(const Tally& tally, const std::optional<Figures>& figures) {
    std::vector<std::string> cells{fmt::format("{} of {}", tally.reference_chosen, tally.n)};
    if (!figures) {
        cells.resize(figure_columns().size(), "n/a");
        return cells;
    }
    const Figures& f = *figures;
    const ParticipantLevel& level = f.participant;
    const double missing = std::nan("");
    for (const std::string& cell :
         {number(f.proportion, 3), interval(f.ci), interval(f.ci_exact), number(f.cohens_g, 3),
          p_cell(f.chi_square.p), p_cell(f.p_exact), p_cell(f.p_holm), p_cell(f.q_bh),
          p_cell(level.sign_flip.p), p_cell(level.p_holm), p_cell(level.t_test ? level.t_test->p : missing),
          p_cell(level.mixed ? level.mixed->p : missing), number(level.mixed ? level.mixed->sd : missing, 2),
          p_cell(level.mixed ? level.mixed->p_heterogeneity : missing), p_cell(f.p_equivalence),
          p_cell(level.p_equivalence.value_or(missing)), bayes(f.log_bf01)}) {
        cells.push_back(cell);
    }
    return cells;
}

std::vector<std::string> with_figures(std::vector<std::string> columns) {
    columns.insert(columns.end(), figure_columns().begin(), figure_columns().end());
    return columns;
}

std::string group_label(const GroupRow& group) {
    const std::string pair =
        fmt::format("{} against {}", shader_label(group.test), shader_label(group.reference));
    return group.by == "all"        ? pair
           : group.by == "distance" ? distance_label(group.level)
                                    : group.level + "\u00b0";
}

} // namespace

std::string table2_html(const Analysis& analysis) {
    const Grid grid = paper_grid(analysis.rows);
    const bool with_n = !grid.n;
    std::string html = paragraph(
        fmt::format("Chi-square of the answers against half and half (df = 1, level of significance {}{}). "
                    "Marked and with a star: no significant difference (p > {}).",
                    alpha, grid.n ? fmt::format(", n = {} answers a condition", *grid.n) : "", alpha),
        "note");
    html += "<div class=\"scroll\"><table class=\"table2\">\n<thead><tr><th></th>";
    std::string columns = "<tr><th scope=\"col\">Configuration</th>";
    for (const std::string& test : grid.tests) {
        html += fmt::format("<th scope=\"colgroup\" colspan=\"{}\">{}</th>", with_n ? 3 : 2,
                            html_text(shader_label(test)));
        columns += with_n ? "<th scope=\"col\">n</th>" : "";
        columns += "<th scope=\"col\">chi-value</th><th scope=\"col\">p-value</th>";
    }
    html += "</tr>\n" + columns + "</tr></thead>\n<tbody>\n";
    for (const GridLine& line : grid.lines) {
        html += fmt::format("<tr><th scope=\"row\">{}</th>", html_text(line.configuration));
        for (const Row* row : line.cells) {
            html += table2_cells(row, with_n);
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string shaders_html(const Analysis& analysis) {
    HtmlTable table("details", with_figures({"Shader", "Verdict"}));
    for (const GroupRow& group : analysis.groups) {
        const bool whole = group.by == "all";
        const std::string label = html_text(group_label(group));
        std::vector<std::string> cells{whole ? "<strong>" + label + "</strong>" : "&emsp;" + label,
                                       group.figures ? verdict_words(*group.figures, analysis.settings.bounds)
                                                     : "n/a"};
        for (std::string& cell : figure_cells(group.tally, group.figures)) {
            cells.push_back(std::move(cell));
        }
        table.add(cells);
    }
    return paragraph(fmt::format(
                         "Each shader over all conditions, by distance and by azimuth. Holm and "
                         "Benjamini\u2013Hochberg run over the {} rows of this table. shaders.tsv has every "
                         "digit.",
                         analysis.groups.size()),
                     "note") +
           table.html();
}

std::string conditions_html(const Analysis& analysis) {
    HtmlTable table("details", with_figures({"Configuration", "Test"}));
    for (const auto& [c, tally, figures] : analysis.rows) {
        std::vector<std::string> cells{html_text(configuration_label(c.reference, c.distance, c.azimuth_deg)),
                                       html_text(shader_label(c.test))};
        for (std::string& cell : figure_cells(tally, figures)) {
            cells.push_back(std::move(cell));
        }
        table.add(cells);
    }
    return paragraph(
               fmt::format(
                   "Holm and Benjamini\u2013Hochberg run over the {} rows of this table. table2.tsv has "
                   "every digit. Marked: p above {}.",
                   analysis.rows.size(), alpha),
               "note") +
           table.html();
}

std::string order_html(const Analysis& analysis) {
    HtmlTable table("details", {"Shader", "First interval chosen", "p", "d\u2032 from proportion correct",
                                "d\u2032 freed from bias", "Bias to the second interval"});
    const auto row = [&](const std::string& label, std::int64_t first, std::int64_t n, double p,
                         const Sensitivity& s) {
        table.add({label, fmt::format("{} of {}", first, n), p_cell(p), number(s.d_prime, 3),
                   number(s.d_prime_order, 3), number(s.bias, 3)});
    };
    for (const GroupRow* group : overall(analysis.groups)) {
        if (group->figures) {
            row(html_text(group_label(*group)), group->figures->first_chosen, group->tally.n,
                group->figures->p_order, group->figures->sensitivity);
        }
    }
    return paragraph(order_sentence(analysis)) + table.html();
}

std::string response_times_html(const Analysis& analysis) {
    HtmlTable table("details", {"Configuration", "Test", "Median", "Quartiles"});
    for (const auto& [c, tally, figures] : analysis.rows) {
        const ResponseTimes times = figures ? figures->response_times : ResponseTimes{NAN, NAN, NAN};
        const bool known = !std::isnan(times.median_s);
        table.add({html_text(configuration_label(c.reference, c.distance, c.azimuth_deg)),
                   html_text(shader_label(c.test)), known ? fmt::format("{:.2f} s", times.median_s) : "n/a",
                   known ? fmt::format("{:.2f} to {:.2f} s", times.q1_s, times.q3_s) : "n/a"});
    }
    return table.html();
}

} // namespace stats
