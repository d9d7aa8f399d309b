#include "report/page_style.h"

namespace nacre {

std::string_view page_style() {
  return R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: #222; font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0.5rem 0; }
h2 { font-size: 1.3rem; margin: 0 0 0.3rem; }
h4 { font-size: 0.9rem; margin: 0.8rem 0 0.2rem; font-weight: 600; }
p, ul, dl { max-width: 46rem; }
section { margin-top: 2.2rem; padding-top: 1.2rem; border-top: 1px solid #ddd; }
nav { display: flex; flex-wrap: wrap; gap: 0.3rem 1rem; margin: 1rem 0; }
a { color: #0b5cad; }
dt { font-weight: 600; margin-top: 0.4rem; break-after: avoid; }
dd { margin: 0; }
@media (min-width: 900px) { details dl { columns: 2; column-gap: 2.5rem; max-width: none; } dd { break-inside: avoid; } }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); gap: 1rem; }
.plots svg { width: 100%; max-width: 560px; height: auto; }
svg text { font-family: inherit; fill: #333; }
svg .title { font-size: 14px; font-weight: 600; }
svg .tick, svg .name { font-size: 11.5px; }
svg .axis { font-size: 12.5px; }
svg .grid { stroke: #e4e4e4; }
svg .band { fill: #f1f1ec; }
.mark { width: 1.1em; height: 1.1em; vertical-align: -0.2em; margin-right: 0.35em; }
.legend span { white-space: nowrap; margin-right: 1.2rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.8rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.26rem 0.42rem; text-align: right; white-space: nowrap; border-bottom: 1px solid #e4e4e4; }
th { vertical-align: bottom; font-weight: 600; background: #f6f6f3; }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left; }
td.out { text-align: left; color: #666; white-space: normal; }
tr.exact td { background: #f1f1ec; }
td small { color: #777; }
details { margin: 0.8rem 0; }
summary { cursor: pointer; color: #0b5cad; }
.pictures { display: flex; flex-wrap: wrap; gap: 0.9rem; margin-top: 0.6rem; }
figure { margin: 0; }
figure img { display: inline-block; width: 144px; height: auto; background: #000; margin-right: 2px; }
figcaption { font-size: 0.78rem; line-height: 1.3; color: #444; }
pre { font: 0.78rem/1.5 ui-monospace, "DejaVu Sans Mono", monospace; background: #f6f6f3; padding: 0.5rem 0.7rem; margin: 0; overflow-x: auto; }
@media (max-width: 560px) { main { padding: 0.7rem; } body { font-size: 15px; } .legend span { display: block; white-space: normal; } }
)";
}

}  // namespace nacre
