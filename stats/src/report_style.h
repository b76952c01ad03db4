// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

namespace stats {

/// The report's style sheet: light and dark, screen and paper.
inline constexpr const char* report_style = R"css(
:root { color-scheme: light dark; --ink: #1c1b1a; --soft: #5d5a57; --paper: #ffffff; --line: #dcd8d3;
        --mark: #fff1c9; --mark-ink: #4a3500; --alarm: #b00020; --same: #b98a00; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #eceae7; --soft: #a8a49f; --paper: #191817; --line: #3c3936;
          --mark: #4b3c12; --mark-ink: #ffe9ad; --alarm: #cf3a50; --same: #e3b341; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
       font: 16px/1.55 "DejaVu Sans", "Segoe UI", Roboto, Helvetica, Arial, sans-serif; }
main { max-width: 72rem; margin: 0 auto; padding: 1.5rem 1.25rem 4rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 1rem 0 .2rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.4rem 0 .6rem; border-top: 1px solid var(--line); padding-top: 1.2rem; }
p, ul { max-width: 46rem; margin: .5rem 0; }
li { overflow-wrap: anywhere; margin: .3rem 0; }
.facts, .note, figcaption { color: var(--soft); font-size: .9rem; }
.banner { background: var(--alarm); color: #fff; font-weight: bold; text-align: center; padding: .6rem 1rem; }
.answer { padding-left: 1.1rem; } .answer strong { font-size: 1.05rem; }
.watermark { display: none; }
.warning { background: var(--mark); color: var(--mark-ink); border-left: 4px solid var(--alarm);
           padding: .6rem 1rem .6rem 2rem; font-weight: bold; max-width: none; }
ul.note { list-style: none; padding-left: 0; }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
.cards { display: flex; flex-wrap: wrap; gap: .6rem; margin: .8rem 0; align-items: flex-start; }
.pair { display: flex; gap: .2rem; border: 2px solid transparent; border-radius: 6px; padding: 2px; }
.pair.same { border-color: var(--same); }
.thumb { margin: 0; width: 8.4rem; } .thumb img { display: block; width: 100%; height: auto; }
.thumb figcaption { font-size: .75rem; line-height: 1.3; }
.scroll, .card { overflow-x: auto; }
/* A shadow at the right edge while there is more to scroll to. */
.scroll { background: linear-gradient(to left, var(--paper) 50%, transparent) 100% 0 / 2rem 100% local no-repeat,
                      linear-gradient(to left, var(--line), transparent) 100% 0 / 1rem 100% scroll no-repeat; }
.scroll th:first-child { position: sticky; left: 0; background: var(--paper); }
table { border-collapse: separate; border-spacing: 0; width: 100%; font-size: .92rem;
        font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .7rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th { font-weight: 600; }
.details { font-size: .8rem; }
.details th, .details td { padding: .2rem .35rem; }
.details thead th { white-space: normal; vertical-align: bottom; }
th[scope=row], th:first-child { text-align: left; }
.details th:nth-child(2), .details td:nth-child(2) { text-align: left; }
@media screen {
  .details td:nth-child(2) { white-space: normal; min-width: 7rem; }
  .details tbody th[scope=row] { white-space: normal; min-width: 7.5rem; } }
th[scope=row] { font-weight: normal; }
th[scope=colgroup] { text-align: center; }
thead tr:last-child th { border-bottom: 2px solid var(--soft); }
.alike { background: var(--mark); color: var(--mark-ink); font-weight: bold; }
figure { margin: 1rem 0; }
.card { background: #fff; border: 1px solid var(--line); border-radius: 8px; padding: .5rem; }
.card svg, .card img { display: block; width: 100%; min-width: 36rem; height: auto; }
@media screen and (max-width: 40rem) {
  .scroll::before, .card::before { content: "Scroll sideways \2192"; position: sticky; left: 0; display: inline-block;
    font-size: .75rem; color: var(--soft); } .card::before { color: #5d5a57; } }
@media print {
  :root { color-scheme: light; --ink: #000; --soft: #444; --paper: #fff; --line: #bbb;
          --mark: #eee; --mark-ink: #000; --alarm: #b00020; }
  html, body { font-size: 9.5pt; } main { max-width: none; padding: 0; }
  .banner { background: #fff; color: #b00020; border: 2px solid #b00020; }
  h2, h3, .note { break-after: avoid; } figure, .table2, tr { break-inside: avoid; }
  .cards, .pair { break-inside: avoid; } .thumb { width: 2.1cm; } .thumb figcaption { font-size: 6pt; }
  .details { font-size: 6.3pt; } .details th, .details td { padding: .1rem .15rem; }
  .details th[scope=row] { white-space: normal; }
  .scroll, .card { overflow: visible; }
  .card svg, .card img { min-width: 0; } .scroll th:first-child { position: static; }
  table { font-size: 8.5pt; } th, td { padding: .15rem .4rem; }
}
)css";

/// On paper, simulated data say so across every page: what is fixed is printed on each.
inline constexpr const char* simulated_page_style = R"css(
@media print {
  .watermark { display: block; position: fixed; top: 45%; left: 0; right: 0; text-align: center; z-index: 1;
               transform: rotate(-30deg); font: bold 52pt sans-serif; color: #b00020; opacity: .13; } }
)css";

} // namespace stats
