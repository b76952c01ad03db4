// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report.h"

#include <fmt/format.h>

#include <support/error.h>
#include <support/file.h>

#include "findings.h"
#include "labels.h"
#include "report_style.h"
#include "table_text.h"

namespace stats {
namespace {

constexpr std::uintmax_t largest_picture = std::uintmax_t{256} << 20;

std::string paragraph(const std::string& text, std::string_view style = "") {
    return fmt::format("<p class=\"{}\">{}</p>\n", style, html_text(text));
}

std::string list_of(const std::vector<std::string>& items, std::string_view style = "") {
    std::string html = fmt::format("<ul class=\"{}\">\n", style);
    for (const std::string& item : items) {
        html += fmt::format("<li>{}</li>\n", html_text(item));
    }
    return html + "</ul>\n";
}

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

std::string table2_html(const Grid& grid) {
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

/// Every figure of every condition, to the digits a reader needs; table2.tsv has them all.
std::string details_html(std::span<const Row> rows) {
    std::string html = paragraph("The same conditions with intervals (Wilson, 95 %), the exact test, and "
                                 "p-values corrected over all rows. table2.tsv has every digit.",
                                 "note");
    html += "<div class=\"scroll\"><table class=\"details\">\n<thead><tr>";
    for (const char* column : {"Configuration", "Test", "Reference chosen", "Proportion", "95 % interval",
                               "p", "p exact", "Holm", "B.\u2013H."}) {
        html += fmt::format("<th scope=\"col\">{}</th>", column);
    }
    html += "</tr></thead>\n<tbody>\n";
    for (const Row& row : rows) {
        const auto& [c, tally, figures] = row;
        html += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"left\">{}</td><td>{} of {}</td>",
                            html_text(configuration_label(c.reference, c.distance, c.azimuth_deg)),
                            html_text(shader_label(c.test)), tally.reference_chosen, tally.n);
        if (!figures) {
            html += "<td>n/a</td><td>n/a</td><td>n/a</td><td>n/a</td><td>n/a</td><td>n/a</td></tr>\n";
            continue;
        }
        html += fmt::format("<td>{:.3f}</td><td>{:.3f} to {:.3f}</td>", figures->proportion, figures->ci.low,
                            figures->ci.high);
        const auto cell = [&](double p) {
            html += fmt::format("<td{}>{:.3g}</td>", p > alpha ? " class=\"alike\"" : "", p);
        };
        cell(figures->chi_square.p);
        cell(figures->p_exact);
        cell(figures->p_holm);
        cell(figures->q_bh);
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string left_out_html(const Study& study) {
    std::vector<std::string> items;
    if (const Contents found = contents(study); found.unanswered > 0) {
        items.push_back(
            fmt::format("{} of {} trials without an answer (n/a)", found.unanswered, found.trials));
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

std::string methods_html(std::size_t tests) {
    return paragraph(fmt::format(
        "In each condition the numbers of answers that chose the reference and the other shader were "
        "compared with "
        "half and half by a one-sample chi-square test (df = 1, no continuity correction, n the number of "
        "answers; "
        "alpha = {}), as Jimenez, Sundstedt and Gutierrez (2009) did. Beside it stand the exact two-sided "
        "binomial "
        "test and Wilson's 95 % score interval of the proportion. P-values of the chi-square test were "
        "corrected "
        "for the {} tests of the table by Holm's method (family-wise error) and by Benjamini and Hochberg's "
        "(false "
        "discovery rate). Figure 8 pools the answers over distances or azimuths. All answers are treated as "
        "independent, as in the paper; answers of one participant need not be, and pooled p-values are then "
        "too "
        "small. No significant difference is not proof that two shaders look equally good. Of each "
        "participant's runs the last complete one counts or, where none is complete, the last that holds "
        "trials.",
        alpha, tests));
}

std::string contact_sheet_html(const std::optional<std::string>& picture) {
    if (!picture) {
        return paragraph(
            "The study's folder holds no stimuli/contact_sheet.png, so the stimuli are not shown here.");
    }
    return fmt::format("<figure><div class=\"card\"><img alt=\"Contact sheet of the stimuli\" "
                       "src=\"data:image/png;base64,{}\"></div>"
                       "<figcaption>Contact sheet of the study's stimuli.</figcaption></figure>\n",
                       base64(*picture));
}

} // namespace

std::string html_text(const std::string& text) {
    std::string out;
    for (const char c : support::one_line(text)) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        case '\'':
            out += "&#39;";
            break;
        default:
            out += c;
        }
    }
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        }
        for (std::size_t j = 0; j < 4; ++j) {
            out += j <= count ? digits[group >> (18 - 6 * j) & 63] : '=';
        }
    }
    return out;
}

std::optional<std::string> read_png(const std::filesystem::path& file) {
    using namespace std::string_view_literals;
    std::error_code ignored;
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) {
        return std::nullopt;
    }
    // A PNG starts with its signature and ends with an empty IEND chunk [PNG2003, sections 5.2 and 11.2.5].
    std::string bytes = support::read_text(file, largest_picture);
    if (!bytes.starts_with("\x89PNG\r\n\x1a\n"sv) || !bytes.ends_with("\0\0\0\0IEND\xae\x42\x60\x82"sv)) {
        throw support::input_error("{}: expected a whole PNG picture, found something else", file.string());
    }
    return bytes;
}

std::string report_html(const Study& study, std::span<const Row> rows, const std::string& figure8_svg,
                        const std::optional<std::string>& contact_sheet) {
    const std::string notice = simulated_notice(study), name = html_text(study.name);
    const Contents found = contents(study);
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{}{}: analysis</title>\n<style>{}{}</style>\n</head>\n<body>\n",
        notice.empty() ? "" : "[simulated] ", name, report_style, notice.empty() ? "" : simulated_page_style);
    if (!notice.empty()) {
        html += fmt::format("<div class=\"banner\" role=\"alert\">{}</div>\n", html_text(notice));
    }
    html += fmt::format(
        "<main>\n<h1>{}</h1>\n<p class=\"facts\">Two-alternative forced choice: {} participants, {} "
        "answers, {} conditions.</p>\n",
        name, found.participants, found.trials - found.unanswered, rows.size());
    html += list_of(findings(rows), "answer");

    html += "<h2>Table II</h2>\n" + table2_html(paper_grid(rows));

    // Inline, the figure goes without its XML declaration.
    html += fmt::format(
        "<h2>Figure 8</h2>\n<figure><div class=\"card\">{}</div>\n<figcaption>{}Proportion of answers "
        "that chose the reference, by light azimuth (left) and camera distance (right): 1 is always the "
        "reference, 0.5 (dashed) no preference. Bars are Wilson 95 % intervals.</figcaption></figure>\n",
        figure8_svg.substr(figure8_svg.find("<svg")), notice.empty() ? "" : html_text(notice) + " ");

    html += "<h2>Every condition</h2>\n" + details_html(rows);
    html += "<h2>Stimuli</h2>\n" + contact_sheet_html(contact_sheet);
    html += "<h2>What was left out</h2>\n" + left_out_html(study);
    html += "<h2>Methods</h2>\n" + methods_html(significance(rows).tests);
    return html + "</main>\n</body>\n</html>\n";
}

} // namespace stats
