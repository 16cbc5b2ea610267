#!/usr/bin/env bash
# Maps three sequences with each sensor model and each way of preprocessing, and rewrites the tables of preprocessing.md.
#   bash docs/results/preprocessing.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
data=${PPM_DATA:-../shared/data}
out=runs/preprocessing
page=docs/results/preprocessing.md
mkdir -p "$out"

node() { echo "  - {name: $1, module: $2, in: {frame: $3.frame}, params: {${4:-}}}"; }  # NAME MODULE INPUT PARAMS

row() {  # SEQUENCE LABEL NODES: the shipped graph with NODES, the last of them called 'solid', between camera and map
  local graph=$out/$1.yaml run=$out/$1
  awk -v nodes="$3" '/name: solid,/ { next }
                     /name: init,/ { print nodes }
                     { gsub(/camera\.frame/, "solid.frame"); print }' "configs/$1_mapping.yaml" >"$graph"
  echo "$1: $2" >&2
  "$ppm" run "$graph" --out "$run" --force --quiet >"$run.log" 2>&1
  jq -r --arg variant "$2" --slurpfile surface "$run/surface.json" --arg dropped "$(dropped "$run/metrics.csv")" '
    def digits(n): . * pow(10; n) | round / pow(10; n);
    [ $variant, $dropped, (.holdout.coverage | digits(4)), (.holdout.median_mm | digits(2)),
      ([.holdout.within_1cm, .holdout.within_2cm, .holdout.within_5cm] | map(digits(3) | tostring) | join(" / ")),
      (.holdout.mean_trunc20cm_mm | digits(2)), ($surface[0].second_layers | digits(4)), (.holdout.log_density | digits(3)),
      .map.faces, ([.nodes | to_entries[] | select(.value.module | test("^(sensor|preprocess)")) | .value.ms_p50] | add | digits(2)) ]
    | map(tostring) | "| " + join(" | ") + " |"' "$run/run.json"
}
dropped() {  # METRICS.CSV: mean share of the pixels that 'solid' dropped, in percent
  awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "solid.dropped") c = i; next }
           c && $c != "" { sum += $c; n++ } END { if (n) printf "%.2f %%", 100 * sum / n; else printf "-" }' "$1"
}
table() {  # SEQUENCE
  echo
  echo "## \`$1\`"
  echo
  echo "| nodes between camera and map | dropped | coverage | median, mm | within 1 / 2 / 5 cm | truncated mean, mm | second layers | log density | faces | ms |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  local shipped=none
  grep -q preprocess.flying_pixels "configs/$1_mapping.yaml" && shipped=flying_pixels
  row "$1" "none$([ $shipped = none ] && echo ' (shipped)')" "$(node solid preprocess.gate camera)"
  row "$1" "\`flying_pixels\`$([ $shipped = flying_pixels ] && echo ' (shipped)')" \
    "$(node solid preprocess.flying_pixels camera)"
  row "$1" "\`flying_pixels: angle_least: 5 deg\`" "$(node solid preprocess.flying_pixels camera 'angle_least: 5 deg')"
  row "$1" "\`flying_pixels: angle_least: 20 deg\`" "$(node solid preprocess.flying_pixels camera 'angle_least: 20 deg')"
  row "$1" "\`flying_pixels: edge: near\`" "$(node solid preprocess.flying_pixels camera 'edge: near')"
  row "$1" "\`flying_pixels: edge: far\`" "$(node solid preprocess.flying_pixels camera 'edge: far')"
  row "$1" "\`flying_pixels: edge: both\` (May et al.)" "$(node solid preprocess.flying_pixels camera 'edge: both')"
  row "$1" "\`bilateral\`" "$(node solid preprocess.bilateral camera)"
  row "$1" "\`flying_pixels\`, \`bilateral\`" \
    "$(node fly preprocess.flying_pixels camera; node solid preprocess.bilateral fly)"
  row "$1" "\`gate: max_range: 3 m\`" "$(node solid preprocess.gate camera 'max_range: 3 m')"
  row "$1" "\`sensor.constant\` (6 mm), \`flying_pixels\`" \
    "$(node noise sensor.constant camera; node solid preprocess.flying_pixels noise)"
  if [ "$1" = room ]; then
    row "$1" "\`sensor.tof\` without amplitude, \`flying_pixels\`" \
      "$(node noise sensor.tof camera; node solid preprocess.flying_pixels noise)"
  else
    row "$1" "\`sensor.kinect\`, \`flying_pixels\`" \
      "$(node noise sensor.kinect camera; node solid preprocess.flying_pixels noise)"
    row "$1" "\`sensor.kinect: grazing: false\`, \`flying_pixels\`" \
      "$(node noise sensor.kinect camera 'grazing: false'; node solid preprocess.flying_pixels noise)"
  fi
}

{
  sed '/^## `/,$d' "$page"
  [ -d "$data/kitchen" ] && table kitchen
  [ -d "$data/icl_kt3" ] && table icl
  table room
} | cat -s >"$page.part"
mv "$page.part" "$page"
echo "wrote $page"
