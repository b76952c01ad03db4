// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

namespace stats {

/// The report's style sheet: light and dark, screen and paper.
inline constexpr const char* report_style = R"css(
:root { color-scheme: light dark; --ink: #1c1b1a; --soft: #5d5a57; --paper: #ffffff; --line: #dcd8d3;
        --mark: #fff1c9; --mark-ink: #4a3500; --alarm: #b00020; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #eceae7; --soft: #a8a49f; --paper: #191817; --line: #3c3936;
          --mark: #4b3c12; --mark-ink: #ffe9ad; --alarm: #cf3a50; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
       font: 16px/1.55 "DejaVu Sans", "Segoe UI", Roboto, Helvetica, Arial, sans-serif; }
main { max-width: 64rem; margin: 0 auto; padding: 1.5rem 1.25rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 1rem 0 .2rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .6rem; border-top: 1px solid var(--line); padding-top: 1.2rem; }
p, ul { max-width: 46rem; margin: .5rem 0; }
li { overflow-wrap: anywhere; margin: .3rem 0; }
.facts, .note, figcaption { color: var(--soft); font-size: .9rem; }
.banner { background: var(--alarm); color: #fff; font-weight: bold; text-align: center; padding: .6rem 1rem; }
.answer { font-size: 1.05rem; padding-left: 1.1rem; }
.scroll, .card { overflow-x: auto; }
.scroll th:first-child { position: sticky; left: 0; background: var(--paper); }
table { border-collapse: separate; border-spacing: 0; width: 100%; font-size: .92rem;
        font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .7rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th { font-weight: 600; }
.details { font-size: .82rem; }
.details th, .details td { padding: .2rem .5rem; }
th[scope=row], th:first-child, .left, .details th:nth-child(2) { text-align: left; }
th[scope=row] { font-weight: normal; }
th[scope=colgroup] { text-align: center; }
thead tr:last-child th { border-bottom: 2px solid var(--soft); }
.alike { background: var(--mark); color: var(--mark-ink); font-weight: bold; }
figure { margin: 1rem 0; }
.card { background: #fff; border: 1px solid var(--line); border-radius: 8px; padding: .5rem; }
.card svg, .card img { display: block; width: 100%; min-width: 36rem; height: auto; }
@media print {
  :root { color-scheme: light; --ink: #000; --soft: #444; --paper: #fff; --line: #bbb;
          --mark: #eee; --mark-ink: #000; --alarm: #b00020; }
  body { font-size: 10pt; } main { max-width: none; padding: 0; }
  .banner { background: #fff; color: #b00020; border: 2px solid #b00020; }
  h2 { break-after: avoid; } figure, .table2, tr { break-inside: avoid; }
  .scroll, .card { overflow: visible; }
  .card svg, .card img { min-width: 0; } .scroll th:first-child { position: static; }
  table { font-size: 8.5pt; } th, td { padding: .15rem .4rem; }
}
)css";

/// On paper, simulated data say so on every page, where the browser can print into the margins.
inline constexpr const char* simulated_page_style =
    "@page { @top-center { content: 'SIMULATED DATA'; color: #b00020; font: bold 10pt sans-serif; } }";

} // namespace stats
