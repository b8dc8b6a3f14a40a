#include "tanglebin/report/page_style.hpp"

namespace tanglebin {

const char* const page_style = R"css(
:root {
  --page: #ffffff; --ink: #1b1f24; --soft: #5b6470; --line: #d4d9df; --shade: #f4f6f8; --link: #00598c;
  --warn: #8a4b00; --warn-shade: #fff6e6;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #14171b; --ink: #e4e7eb; --soft: #a3acb8; --line: #363d46; --shade: #1c2127; --link: #7cc4f0;
    --warn: #f0bf70; --warn-shade: #2b2416;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body {
  margin: 0 auto; padding: 2.5rem 1.25rem 4rem; max-width: 68rem; background: var(--page); color: var(--ink);
  font: 1rem/1.55 system-ui, -apple-system, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif;
  overflow-wrap: break-word;
}
h1, h2 { font-family: Charter, "Bitstream Charter", Georgia, "DejaVu Serif", serif; line-height: 1.2; font-weight: 600; }
h1 { font-size: 2.1rem; margin: 0.2rem 0 1rem; letter-spacing: -0.01em; }
h2 { font-size: 1.4rem; margin: 0 0 1rem; }
p { margin: 0 0 0.8rem; max-width: 44rem; }
a { color: var(--link); }
code, pre { font-family: ui-monospace, "SF Mono", "DejaVu Sans Mono", monospace; font-size: 0.875em; }
.kicker { margin: 0; color: var(--soft); font-size: 0.8rem; letter-spacing: 0.12em; text-transform: uppercase; }
.lead { font-size: 1.13rem; }
.note { color: var(--soft); font-size: 0.9rem; }
.missing, .warning {
  border-left: 3px solid var(--warn); background: var(--warn-shade); color: var(--warn); padding: 0.5rem 0.8rem;
  font-size: 0.95rem;
}
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 0.25rem 1.25rem; margin: 1.5rem 0 0; font-size: 0.9rem; }
dt { color: var(--soft); }
dd { margin: 0; }
nav { margin: 1.75rem 0 0; padding: 0.7rem 0; border: solid var(--line); border-width: 1px 0; font-size: 0.9rem; }
nav ul { display: flex; flex-wrap: wrap; gap: 0.3rem 1.4rem; margin: 0; padding: 0; list-style: none; }
nav a { text-decoration: none; }
nav a:hover { text-decoration: underline; }
section { margin-top: 3.25rem; }
figure { margin: 0 0 1.75rem; }
figcaption { font-size: 0.9rem; line-height: 1.45; color: var(--soft); max-width: 44rem; }
figcaption b { color: var(--ink); }
.plot { color: var(--ink); }
div + figcaption { margin-top: 0.6rem; max-width: 34rem; }
.table figcaption { margin-bottom: 0.5rem; }
.scroll { overflow-x: auto; }
.scroll:focus-visible { outline: 2px solid var(--link); outline-offset: 2px; }
table {
  border-collapse: collapse; font-size: 0.85rem; line-height: 1.35; font-variant-numeric: tabular-nums;
  border: solid var(--ink); border-width: 1.5px 0;
}
th, td { padding: 0.24rem 0.55rem; text-align: right; white-space: nowrap; font-weight: 400; }
thead th { color: var(--soft); vertical-align: bottom; }
thead tr:last-child th { border-bottom: 1px solid var(--ink); }
thead th[rowspan] { border-bottom: 1px solid var(--ink); }
th[scope="colgroup"] { text-align: center; color: var(--ink); border-bottom: 1px solid var(--line); }
tbody th { font-weight: 600; }
tbody th, thead th:first-child { position: sticky; left: 0; background: var(--page); }
tbody tr:nth-child(even), tbody tr:nth-child(even) th { background: var(--shade); }
td.published { color: var(--soft); font-style: italic; }
.side-by-side { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 28rem), 1fr)); gap: 0 2rem; }
.side-by-side > * { min-width: 0; }
.side-by-side table { width: 100%; font-size: 0.8rem; }
.side-by-side th, .side-by-side td { padding-left: 0.3rem; padding-right: 0.3rem; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 0.75rem; }
.pair > div { min-width: 0; }
.pair img { display: block; width: 100%; height: auto; border: 1px solid var(--line); border-radius: 3px; }
.pair p { margin: 0.2rem 0 0.3rem; font-size: 0.8rem; color: var(--soft); text-align: center; }
pre {
  overflow-x: auto; padding: 0.8rem 1rem; background: var(--shade); border: 1px solid var(--line); border-radius: 3px;
  line-height: 1.6;
}
footer { margin-top: 3.5rem; padding-top: 1rem; border-top: 1px solid var(--line); font-size: 0.85rem; color: var(--soft); }
@media (max-width: 36rem) {
  body { padding: 1.25rem 0.85rem 3rem; }
  h1 { font-size: 1.6rem; }
  h2 { font-size: 1.25rem; }
  section { margin-top: 2.5rem; }
  dl { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dd { margin-bottom: 0.5rem; }
  .pair { gap: 0.4rem; }
}
@media print {
  @page { size: A4; margin: 16mm 14mm; }
  :root {
    --page: #ffffff; --ink: #000000; --soft: #444444; --line: #bbbbbb; --shade: #ffffff; --link: #000000;
    --warn: #000000; --warn-shade: #ffffff; color-scheme: light;
  }
  body { max-width: none; padding: 0; font-size: 10pt; }
  nav { display: none; }
  section { margin-top: 8mm; }
  h2, .table figcaption { break-after: avoid; }
  figure, tr, pre { break-inside: avoid; }
  thead { display: table-header-group; }
  .scroll, pre { overflow: visible; }
  pre { white-space: pre-wrap; }
  .plot { max-width: 12cm; }
  .side-by-side { display: block; }
  table, .side-by-side table { width: auto; font-size: 7.5pt; }
  th, td { padding: 1.5pt 4pt; }
  .wide table { font-size: 6.5pt; }
  .wide th, .wide td { padding: 1.5pt 2pt; }
  tbody tr { border-bottom: 0.25pt solid var(--line); }
}
)css";

}  // namespace tanglebin
