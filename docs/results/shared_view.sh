#!/usr/bin/env bash
# Weighs particles against shared and exact views, runs the graph with 1,000 particles, and rewrites the tables of
# shared_view.md.
#   bash docs/results/shared_view.sh [SEEDS]     SEEDS: for example "7 8 9" (the default)
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
weights=$(dirname "$ppm")/shared_view_weights
data=${PPM_DATA:-../shared/data}
seeds=${1:-7 8 9}
out=runs/shared_view
page=docs/results/shared_view.md
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

table() {  # TITLE SOURCE PARAMETERS FRAMES DETAIL
  echo "shared_view_weights $2 $3, detail $5" >&2
  printf '\n### %s, `detail: %s`\n\n' "$1" "$5"
  "$weights" "$2" "$3" "$4" 100 "detail: $5" 2>/dev/null
}
row() {  # LABEL NAME
  jq -r --arg text "$1" '
    def r(n): . * n | round / n;
    "| \($text) | \(.seed) | \(.frames) | \(.particles) | \(.trajectory.ate_rmse_m | r(10000)) | " +
    "\(.trajectory.rpe_trans_rmse_m | r(10000)) / \(.trajectory.rpe_rot_rmse_deg | r(1000)) | " +
    "\(.holdout.coverage | r(1000)) / \(.holdout.median_mm | r(10)) | \(.nodes.look.ms_mean + .nodes.weigh.ms_mean | r(10)) | " +
    "\(.nodes.view.ms_mean * .nodes.view.runs / .frames + .nodes.update.ms_mean * .nodes.update.runs / .frames | r(10)) | " +
    "\(.fps | r(10)) |"' "$out/$2/run.json"
}

sed '/^<!-- tables -->$/q' "$page" >"$page.part"
{
  echo
  echo "## Log weights"
  for detail in 1 2; do
    table "Kitchen" source.seven_scenes "{path: $data/kitchen, pixel_stride: 2}" 80 $detail
    table "Room" source.synthetic_room "{frames: 380}" 80 $detail
  done
  echo
  echo "## A filter with 1,000 particles"
  echo
  echo "\`configs/kitchen_slam_shared.yaml\` and, for comparison, \`configs/kitchen_slam_motion.yaml\`, \`--set camera.last=299\`; $(nproc) threads."
  echo
  echo "| graph | seed | frames | particles | ATE, m | RPE, m / deg | held-out coverage / median, mm | look and weigh, ms a frame | exact views and update | frames/s |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  for graph in kitchen_slam_shared kitchen_slam; do
    for seed in $seeds; do
      echo "ppm run configs/$graph.yaml --seed $seed" >&2
      "$ppm" run "configs/$graph.yaml" --seed "$seed" --set camera.last=299 --out "$out/${graph}_$seed" --force \
        >"$out/${graph}_$seed.log" 2>&1
      row $graph "${graph}_$seed"
    done
  done
} >>"$page.part"
mv "$page.part" "$page"
