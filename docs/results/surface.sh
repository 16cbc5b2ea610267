#!/usr/bin/env bash
# Maps the two worlds whose true surface is known and rewrites surface.md: how accurate and how complete the maps' surfaces are.
#   bash docs/results/surface.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
out=runs/surface
page=docs/results/surface.md
mkdir -p "$out"

row() {  # TITLE GRAPH OPTIONS...
  local title=$1 graph=$2; shift 2
  echo "ppm run configs/$graph.yaml $*" >&2
  "$ppm" run "configs/$graph.yaml" --out "$out/$graph" --threads 1 --quiet --force "$@" >&2
  jq -r --arg title "$title" '[$title, (.surface | [.accuracy_median_mm, .accuracy_mean_mm, .completeness_median_mm, .completeness_mean_mm]
      | map(. * 100 | round / 100) | .[]),
      (.surface | [.precision_2cm, .recall_2cm, .f_score_2cm] | map(. * 10000 | round / 10000) | .[]),
      (.holdout.median_mm * 100 | round / 100), (.map.bytes / 1048576 * 100 | round / 100)]
    | "| " + (map(tostring) | join(" | ")) + " |"' "$out/$graph/run.json"
}

{
  cat <<'TEXT'
# Accuracy and completeness of surfaces

Written by `bash docs/results/surface.sh`. Two worlds whose true surface is known: the embedded room (44 x 36 degrees, 380 frames) and the
house (loop of 31 m), both seen by a simulated time-of-flight camera with noise, flying pixels and drop-outs; reference poses unless it
says SLAM. Definitions: [metrics](../metrics.md#surface); graphs as they ship, default sizes. Distances in mm, median / mean.

| map | accuracy | mean | completeness | mean | precision 2 cm | recall 2 cm | F | held-out median, mm | map, MiB |
|---|---|---|---|---|---|---|---|---|---|
TEXT
  row "room, PPM" room_mapping
  row "room, occupancy grid" room_mapping_vdb
  row "room, PPM, SLAM" room
  row "room, occupancy grid, SLAM" room_vdb
  row "house, PPM" house_mapping
  row "house, occupancy grid" house_mapping_vdb
  cat <<'TEXT'

The losses first. PPM leaves more of the surface out than the grid: at the gaps between books, the leaves of plants, the creases of
cushions, where an image's neighbouring pixels are cut apart at depth jumps, and at thin cracks in walls and floors. In the room that costs it the better
F-score. What it has lies nearer to the truth in the median, and takes a quarter of the grid's memory in the room and less than a
twentieth in the house. Of what is more than 5 cm off in the house (2 % of its surface), most are streaks between the edge of a near thing and the
wall behind it, from flying pixels.
TEXT
} >"$page.part"
mv "$page.part" "$page"
cat "$page"
