#include "apps/report/page_parts.hpp"

namespace ppm::report {

const char* page_style() {
  return R"(
:root { color-scheme: light; }
body { font: 15px/1.45 system-ui, "Liberation Sans", Arial, sans-serif; color: #1a1a1a; background: #fff; margin: 0 auto; padding: 1em; max-width: 1180px; }
h1 { font-size: 1.6em; } h2 { font-size: 1.35em; border-bottom: 2px solid #1a1a1a; margin-top: 2em; } h3 { font-size: 1.1em; margin-top: 1.6em; }
p, li { max-width: 50em; }
.wide { overflow-x: auto; margin: .6em 0; }
table { border-collapse: collapse; font-size: .86em; font-variant-numeric: tabular-nums; }
th, td { padding: .25em .6em; text-align: right; vertical-align: top; border-bottom: 1px solid #ddd; }
th { vertical-align: bottom; border-bottom: 1px solid #888; } th:first-child, td:first-child, .t td, .t th { text-align: left; } .cells td:nth-child(2) { white-space: nowrap; }
td small { display: block; color: #555; white-space: nowrap; } td b { font-weight: 700; }
tr.no td:first-child, tr.worse td:first-child { border-left: 4px solid #d55e00; }
tr.yes td:first-child, tr.better td:first-child { border-left: 4px solid #0072b2; }
tr.open td:first-child, tr.tie td:first-child { border-left: 4px solid #bbb; }
tr.subject td { background: #f3f6fa; }
caption { caption-side: top; text-align: left; font-weight: 600; padding: .3em 0; }
.plots { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(480px, 100%), 1fr)); gap: 8px; } .plots figure { margin: 0; }
svg.plot { width: 100%; height: auto; display: block; } svg.plot text { font: 11.5px system-ui, "Liberation Sans", Arial, sans-serif; fill: #1a1a1a; }
svg.plot .head { font-weight: 600; font-size: 13px; } svg.plot .x { text-anchor: middle; } svg.plot .y { text-anchor: end; }
svg.plot .grid { stroke: #e6e6e6; fill: none; } svg.plot .axis { stroke: #666; fill: none; } svg.plot .diagonal { stroke: #999; stroke-dasharray: 4 4; fill: none; }
svg.plot .band { opacity: .15; stroke: none; } svg.plot .line { fill: none; stroke-width: 1.8; stroke-linejoin: round; } svg.plot .leader { stroke: #ccc; fill: none; }
.views { display: grid; grid-template-columns: repeat(auto-fill, minmax(175px, 1fr)); gap: 6px; }
.views figure, .maps figure { margin: 0; } .views img, .maps img { width: 100%; height: auto; display: block; background: #eee; }
.maps { display: grid; grid-template-columns: repeat(auto-fill, minmax(320px, 1fr)); gap: 8px; } figcaption { font-size: .8em; }
pre { font-size: .78em; overflow-x: auto; background: #f7f7f7; padding: .6em; white-space: pre-wrap; overflow-wrap: anywhere; }
pre .minus { background: #fde8dc; display: block; } pre .plus { background: #dcecf8; display: block; }
details { margin: .5em 0; } summary { cursor: pointer; font-weight: 600; }
@media print {
  body { font-size: 10px; max-width: none; padding: 0; } .wide { overflow: visible; } table { font-size: .8em; } th, td { padding: .15em .35em; }
  h2, h3, caption { break-after: avoid; } figure, tr { break-inside: avoid; } .plots { grid-template-columns: 1fr 1fr; } td small { white-space: normal; }
}
)";
}

}  // namespace ppm::report
