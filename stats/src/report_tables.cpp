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
    const std::string text = std::isnan(p) ? "n/a" : p < 1e-4 ? "&lt;&nbsp;0.0001" : fmt::format("{:.3g}", p);
    return p > alpha ? fmt::format("<span class=\"alike\">{}</span>", text) : text;
}

std::string interval(const Interval& ci) { return fmt::format("{:.3f} to {:.3f}", ci.low, ci.high); }

std::string bayes(double log_bf01) {
    return std::abs(log_bf01) < 9 ? fmt::format("{:.3g}", std::exp(log_bf01))
           : log_bf01 > 0         ? "&gt; 8000"
                                  : "&lt; 0.0001";
}

/// A table's columns after those that name the row, and their cells for one row.
struct Columns {
    std::vector<std::string> names;
    std::vector<std::string> (*cells)(const Tally&, const Figures&);
};

const Columns& pooled_columns() {
    static const Columns columns{
        {"Reference chosen", "Propor&shy;tion", "Wilson 95 %, pooled", "Exact 95 %, pooled", "g", "p",
         "p exact", "Holm of p", "B.\u2013H. of p", "Equiva&shy;lence p", "BF<sub>01</sub>"},
        [](const Tally& tally, const Figures& f) {
            return std::vector<std::string>{fmt::format("{} of {}", tally.reference_chosen, tally.n),
                                            number(f.proportion, 3),
                                            interval(f.ci),
                                            interval(f.ci_exact),
                                            number(f.cohens_g, 3),
                                            p_cell(f.chi_square.p),
                                            p_cell(f.p_exact),
                                            p_cell(f.p_holm),
                                            p_cell(f.q_bh),
                                            p_cell(f.p_equivalence),
                                            bayes(f.log_bf01)};
        }};
    return columns;
}

const Columns& participant_columns() {
    static const Columns columns{
        {"Partici&shy;pants", "Mean propor&shy;tion", "t 95 %", "Sign-flip p", "Holm of it", "t-test p",
         "Equiva&shy;lence p (t)", "Mixed model: logit", "standard error", "p", "SD between", "p of SD"},
        [](const Tally&, const Figures& f) {
            const ParticipantLevel& level = f.participant;
            const double missing = std::nan("");
            const MixedModel mixed =
                level.mixed.value_or(MixedModel{missing, missing, missing, missing, 0, missing});
            const std::string error =
                level.sign_flip.exact ? "" : fmt::format(" \u00b1 {:.2g}", level.sign_flip.standard_error);
            return std::vector<std::string>{fmt::format("{}", level.participants),
                                            level.mean ? number(level.mean->mean, 3) : "n/a",
                                            level.mean ? interval(level.mean->ci) : "n/a",
                                            p_cell(level.sign_flip.p) + error,
                                            p_cell(level.p_holm),
                                            p_cell(level.t_test ? level.t_test->p : missing),
                                            p_cell(level.p_equivalence.value_or(missing)),
                                            number(mixed.intercept, 3),
                                            number(mixed.standard_error, 3),
                                            p_cell(mixed.p),
                                            number(mixed.sd, 3),
                                            p_cell(mixed.p_heterogeneity)};
        }};
    return columns;
}

/// A row's heading cells with its tally and figures.
struct TableRow {
    std::vector<std::string> head;
    const Tally& tally;
    const std::optional<Figures>& figures;
};

std::string figures_table(std::vector<std::string> names, const std::vector<TableRow>& rows,
                          const Columns& columns) {
    const std::size_t heads = names.size();
    names.insert(names.end(), columns.names.begin(), columns.names.end());
    HtmlTable table("details", names);
    for (const TableRow& row : rows) {
        std::vector<std::string> cells(row.head.begin(),
                                       row.head.begin() + static_cast<std::ptrdiff_t>(heads));
        if (row.figures) {
            const auto further = columns.cells(row.tally, *row.figures);
            cells.insert(cells.end(), further.begin(), further.end());
        }
        cells.resize(names.size(), "n/a");
        table.add(cells);
    }
    return table.html();
}

/// Both tables: participants as the sample, with all heading cells, and answers, with those that name the
/// row.
std::string both_tables(const std::vector<std::string>& names, std::size_t naming,
                        const std::vector<TableRow>& rows) {
    const std::vector<std::string> fewer(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(naming));
    return "<h3>Participants as the sample</h3>\n" + figures_table(names, rows, participant_columns()) +
           "<h3>Answers as the sample</h3>\n" + figures_table(fewer, rows, pooled_columns());
}

std::string group_label(const GroupRow& group) {
    const std::string pair =
        fmt::format("{} against {}", shader_label(group.test), shader_label(group.reference));
    return group.by == "all"        ? pair
           : group.by == "distance" ? distance_label(group.level)
                                    : group.level + "\u00b0";
}

/// What a table's p-values are corrected for, and where its digits are.
std::string corrections(std::size_t rows, std::string_view file) {
    return fmt::format("Corrected over {} of the table: the sign-flip p by Holm, the chi-square's p by Holm "
                       "and Benjamini\u2013Hochberg; no other p. Marked: p above {}. {} has every digit.",
                       all_counted(rows, "row"), alpha, file);
}

} // namespace

std::string table2_html(const Analysis& analysis) {
    const Grid grid = paper_grid(analysis.rows);
    const bool with_n = !grid.n;
    std::string html = paragraph(
        fmt::format(
            "As the paper tests: chi-square of all answers, pooled, against half and half (df = 1, level of "
            "significance {}{}). Marked and with a star: no significant difference (p > {}).",
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
    std::vector<TableRow> rows;
    for (const GroupRow& group : analysis.groups) {
        const std::string label = html_text(group_label(group));
        rows.push_back({{group.by == "all" ? "<strong>" + label + "</strong>" : "&emsp;" + label,
                         html_text(verdict_words(group, analysis.settings.bounds))},
                        group.tally,
                        group.figures});
    }
    return paragraph(
               "Each shader over all conditions, and by distance and by azimuth where there are several. " +
                   corrections(analysis.groups.size(), "shaders.tsv"),
               "note") +
           both_tables({"Shader", "Verdict"}, 1, rows);
}

std::string conditions_html(const Analysis& analysis) {
    std::vector<TableRow> rows;
    for (const auto& [c, tally, figures] : analysis.rows) {
        rows.push_back({{html_text(configuration_label(c.reference, c.distance, c.azimuth_deg)),
                         html_text(shader_label(c.test))},
                        tally,
                        figures});
    }
    return paragraph(corrections(analysis.rows.size(), "table2.tsv"), "note") +
           both_tables({"Configuration", "Test"}, 2, rows);
}

std::string order_html(const Analysis& analysis) {
    HtmlTable table("details", {"Shader", "First interval chosen", "Freed from preference", "Sign-flip p",
                                "Pooled p", "d\u2032 from proportion correct", "d\u2032 freed from bias",
                                "Bias to the second interval"});
    for (const GroupRow* group : overall(analysis.groups)) {
        if (!group->figures) {
            continue;
        }
        const Figures& f = *group->figures;
        const auto& bias = f.participant.order;
        const Sensitivity& s = f.sensitivity;
        table.add({html_text(group_label(*group)), fmt::format("{} of {}", f.first_chosen, group->tally.n),
                   bias ? number(bias->first_share, 3) : "n/a",
                   p_cell(bias ? bias->sign_flip.p : std::nan("")), p_cell(f.p_order), number(s.d_prime, 3),
                   number(s.d_prime_order, 3), number(s.bias, 3)});
    }
    return paragraph(order_sentence(analysis)) + table.html() +
           paragraph(
               "Freed from preference: within each condition answered in both orders, the reference is "
               "chosen as often first as second if there is no bias. The sign-flip test takes the "
               "participants as the sample; the pooled p takes all answers as independent, and where one "
               "order is more frequent a preference makes it small, too. No p is corrected.",
               "note");
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
