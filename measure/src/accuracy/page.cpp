// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include "report.h"

#include <algorithm>

#include <fmt/format.h>

#include <support/error.h>

namespace measure {
namespace {

constexpr const char* style = R"css(
:root { color-scheme: light dark; --ink: #1c1b1a; --soft: #5d5a57; --paper: #fff; --line: #dcd8d3; --mark: #fff1c9; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #eceae7; --soft: #a8a49f; --paper: #191817; --line: #3c3936; --mark: #4b3c12; } }
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem 1.25rem 4rem; background: var(--paper); color: var(--ink);
       font: 16px/1.55 "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.2; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; }
p, ul { max-width: 50rem; } .note { color: var(--soft); font-size: .9rem; }
.scroll, .card { overflow-x: auto; } .card { background: #fff; border: 1px solid var(--line); border-radius: 8px; }
.card svg { display: block; width: 100%; min-width: 50rem; height: auto; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .7rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
.left { text-align: left; } .front td { background: var(--mark); }
)css";

std::string html_text(const std::string& text) {
    std::string html;
    for (const char c : support::one_line(text)) {
        switch (c) {
        case '&':
            html += "&amp;";
            break;
        case '<':
            html += "&lt;";
            break;
        case '>':
            html += "&gt;";
            break;
        case '"':
            html += "&quot;";
            break;
        default:
            html += c;
        }
    }
    return html;
}

/// A table's head; the first columns are texts.
std::string table_head(const std::vector<std::string>& columns, std::size_t texts) {
    std::string html = "<div class=\"scroll\"><table><thead><tr>";
    for (std::size_t i = 0; i < columns.size(); ++i) {
        html += fmt::format("<th{}>{}</th>", i < texts ? " class=\"left\"" : "", html_text(columns[i]));
    }
    return html + "</tr></thead>\n<tbody>\n";
}

std::string summary_cells(const Summary& one) {
    return fmt::format("<td class=\"left\">{}</td><td class=\"left\">{}</td><td>{:.2f}</td><td>{:.2f}</td>"
                       "<td>{:.2f}</td><td>{:.5f}</td><td>{:.5f}</td><td>{:.3f}</td><td>{:.5f}</td></tr>\n",
                       html_text(one.shader), html_text(one.setting), one.time_ms, one.time_spread_ms,
                       one.scatter_ms, one.flip, one.rmse, one.de2000_mean, one.ssim);
}

const std::vector<std::string> figures{
    "ms", "spread, ms", "scattering, ms", "FLIP", "RMSE", "CIEDE2000 mean", "SSIM"};

std::vector<std::string> columns(std::vector<std::string> texts) {
    texts.insert(texts.end(), figures.begin(), figures.end());
    return texts;
}

std::string front_html(std::span<const Summary> summaries) {
    std::string html;
    for (const std::string& distance : distances_of(summaries)) {
        html += fmt::format("<h3>{}</h3>\n", html_text(distance));
        html += table_head(columns({"", "shader", "setting"}), 3);
        int number = 0;
        for (const Summary& one : front_of(summaries, distance)) {
            html += fmt::format("<tr><td class=\"left\">{}</td>{}", ++number, summary_cells(one));
        }
        html += "</tbody></table></div>\n";
    }
    return html;
}

std::string all_html(std::span<const Summary> summaries) {
    std::string html = table_head(columns({"distance", "shader", "setting"}), 3);
    for (const std::string& distance : distances_of(summaries)) {
        for (const Summary& one : summaries) {
            if (one.distance == distance) {
                html +=
                    fmt::format("<tr{}><td class=\"left\">{}</td>{}", one.on_front ? " class=\"front\"" : "",
                                html_text(distance), summary_cells(one));
            }
        }
    }
    return html + "</tbody></table></div>\n";
}

/// A row a setting and distance, a column a scene.
std::string closed_forms_html(std::span<const ClosedFormRow> rows) {
    std::vector<std::string> scenes;
    for (const ClosedFormRow& row : rows) {
        if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end()) {
            scenes.push_back(row.scene);
        }
    }
    std::vector<std::string> names{"distance", "shader", "setting"};
    names.insert(names.end(), scenes.begin(), scenes.end());
    std::string html = table_head(names, 3);
    for (const ClosedFormRow& first : rows) {
        if (first.scene != scenes.front()) {
            continue;
        }
        html +=
            fmt::format("<tr><td class=\"left\">{}</td><td class=\"left\">{}</td><td class=\"left\">{}</td>",
                        html_text(first.distance), html_text(first.shader), html_text(first.setting));
        for (const std::string& scene : scenes) {
            for (const ClosedFormRow& row : rows) {
                if (row.scene == scene && row.shader == first.shader && row.setting == first.setting &&
                    row.distance == first.distance) {
                    html += fmt::format("<td>{:.3f} %</td>", 100 * row.error);
                }
            }
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

} // namespace

std::string accuracy_html(const AccuracyResult& result, std::span<const Summary> summaries,
                          const std::string& svg) {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width\">"
        "<title>Run time against error</title>\n<style>{}</style></head>\n<body>\n"
        "<h1>Run time against error</h1>\n<p class=\"note\">{} · {} · {}x{} · {} · {} · {}"
        "{}</p>\n<ul>\n",
        style, html_text(result.model), html_text(result.protocol), result.width, result.height,
        html_text(result.driver), html_text(result.processor), result.date, result.quick ? " · quick" : "");
    for (const std::string& sentence : accuracy_findings(result, summaries)) {
        html += fmt::format("<li>{}</li>\n", html_text(sentence));
    }
    html += fmt::format("</ul>\n<div class=\"card\">{}</div>\n", svg.substr(svg.find("<svg")));
    html += "<h2>On the front</h2>\n<p class=\"note\">No other setting at the same distance is both faster "
            "and nearer to "
            "the reference by FLIP. The numbers are those of the figure.</p>\n";
    html += front_html(summaries);
    html += fmt::format(
        "<h2>All settings</h2>\n<p class=\"note\">Times are of a whole frame, from the shadow map to the "
        "finished "
        "bytes, at a light that no frame before had: the median of {} rounds and the median absolute "
        "deviation; "
        "scattering is the part that no_sss does without. Each round timed every setting in every view once, "
        "in a "
        "drawn order. Model, camera, light, image size, multisampling, bloom and machine are the same for "
        "all. Errors "
        "are against the reference with the study's own profile, which took {:.1f} s a view on the CPU; FLIP "
        "at {:.2f} "
        "pixels per degree over all pixels, the others over the head. Rows on the front are marked.</p>\n",
        result.rounds, result.reference_s, result.pixels_per_degree);
    html += all_html(summaries);
    html +=
        "<h2>Scenes with a closed form</h2>\n<p class=\"note\">Root mean square error as a share of the lit "
        "level: "
        "within 6 mm of a plane's edge of light, facing the camera and turned by 30° and 60°; within 3 mm of "
        "a lit "
        "square of 1 mm, as a share of its brightest; on a sphere and a plane that are lit everywhere.</p>\n";
    html += closed_forms_html(result.closed_forms);
    return html + "</body></html>\n";
}

} // namespace measure
