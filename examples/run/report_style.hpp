// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// The look of report.html. Colours are Okabe and Ito's (2008), which the colour-blind tell apart; lines differ in their
// dashes and marks in their shapes, too.

namespace stillpoint_run {

inline constexpr char kReportStyle[] = R"css(
:root { color-scheme: light dark; --paper: #fcfcfb; --card: #fff; --ink: #1b1f23; --soft: #57606a; --rule: #d8dce0;
  --blue: #0072b2; --orange: #d55e00; --green: #00845f; --yellow: #e69f00; --purple: #9b5a86; --sky: #56b4e9; }
@media (prefers-color-scheme: dark) { :root { --paper: #14171a; --card: #1c2024; --ink: #e8eaec; --soft: #a3abb3;
  --rule: #383e44; --blue: #5ab6ea; --orange: #f08a3c; --green: #2fc396; --yellow: #e8b74a; --purple: #d795bf;
  --sky: #2f7fb0; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 76rem; margin: 0 auto; padding: 1.5rem 1rem 3rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .6rem; }
h2 { font-size: 1.25rem; margin: 2.2rem 0 .8rem; }
h3 { font-size: 1rem; margin: 0 0 .3rem; }
.lead { font-size: 1.15rem; max-width: 46rem; margin: 0 0 .5rem; }
.lead + .more { margin-top: 0; }
.more { max-width: 46rem; color: var(--soft); margin: .3rem 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(10.5rem, 1fr)); gap: .8rem; margin: 1.4rem 0 0;
  padding: 0; }
.tiles div { background: var(--card); border: 1px solid var(--rule); border-radius: .5rem; padding: .7rem .9rem; }
.tiles dt { color: var(--soft); font-size: .88rem; }
.tiles dd { margin: 0; font-size: 1.45rem; font-variant-numeric: tabular-nums; }
.tiles small { display: block; font-size: .85rem; color: var(--soft); }
.plots, .frames { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fill, minmax(min(28rem, 100%), 1fr)); }
.frames { grid-template-columns: repeat(auto-fill, minmax(min(22rem, 100%), 1fr)); }
figure { margin: 0; background: var(--card); border: 1px solid var(--rule); border-radius: .5rem; padding: .8rem; }
figure svg, figure img { display: block; width: 100%; height: auto; }
figcaption { color: var(--soft); font-size: .88rem; margin-top: .3rem; }
.legend { list-style: none; display: flex; flex-wrap: wrap; gap: .1rem 1rem; margin: .2rem 0; padding: 0;
  font-size: .9rem; }
.legend li { display: flex; align-items: center; gap: .4rem; }
.legend svg { width: 30px; height: 14px; flex: none; }
svg text { font: 14px system-ui, sans-serif; fill: var(--soft); font-variant-numeric: tabular-nums; }
.grid { stroke: var(--rule); fill: none; }
.line { fill: none; stroke-width: 2.2; stroke-linejoin: round; stroke-linecap: round; }
.filtered { stroke: var(--blue); }
.unfiltered { stroke: var(--orange); stroke-dasharray: 7 4; }
.truth { stroke: var(--ink); stroke-width: 1.8; stroke-dasharray: 1 4; }
.area { stroke: var(--card); stroke-width: .6; }
.area0 { fill: var(--blue); } .area1 { fill: var(--yellow); } .area2 { fill: var(--purple); }
.area3 { fill: var(--soft); }
.mark0 { fill: var(--ink); stroke: var(--ink); } .mark1 { fill: var(--orange); stroke: var(--orange); }
.mark2 { fill: var(--purple); stroke: var(--purple); } .mark3 { fill: var(--green); stroke: var(--green); }
.kept { stroke: #3cc873; fill: none; } .dynamic { stroke: #f05528; fill: none; }
.unknown { stroke: #8f8f8f; fill: none; } .box { stroke: #d9c400; fill: none; }
.shape { stroke-width: 2; }
.tables { display: grid; gap: 1.5rem 2rem; grid-template-columns: repeat(auto-fit, minmax(min(24rem, 100%), 1fr)); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .93rem; }
caption { text-align: left; font-weight: 600; padding-bottom: .3rem; }
th, td { text-align: left; padding: .28rem .8rem .28rem 0; border-bottom: 1px solid var(--rule); font-weight: normal;
  vertical-align: top; overflow-wrap: anywhere; }
thead th { color: var(--soft); overflow-wrap: normal; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
footer { color: var(--soft); font-size: .88rem; margin-top: 2.5rem; }
@media (max-width: 30rem) { svg text { font-size: 17px; } h1 { font-size: 1.4rem; } }
@media print { body { background: #fff; } figure { break-inside: avoid; } }
)css";

}  // namespace stillpoint_run
