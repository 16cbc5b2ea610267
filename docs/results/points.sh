#!/usr/bin/env bash
# Maps of points and registration to them: runs the graphs and rewrites the tables of points.md.
#   bash docs/results/points.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
export PPM_DATA=${PPM_DATA:-../shared/data}
out=runs/points
page=docs/results/points.md
mkdir -p "$out"

# A graph for meshes, with points in their place.
pointed() {
  sed -e 's/map\.ppm_empty/map.points/; s/prediction\.raster/prediction.points/; s/map_update\.ppm_bayes/map_update.points/; s/, between: nothing//' \
    -e '/module: simplify\./d; /module: sink\.\(mesh_ply\|export\|map_ppm\|surface_report\|image\)/d' "configs/$1.yaml"
}
# One hypothesis, registered by motion.icp, from a graph for several.
registered() {
  pointed "$1" | sed -e '/module: weighting\./d; /module: recovery\./d; /module: resampling\./d; /name: look,/d' \
    -e 's/particles: 4/particles: 1/; s/module: motion\.aligned, in: {frame: \([a-z.]*\), view: look}/module: motion.icp, in: {frame: \1}/' \
    -e '/params: {view_stride: 1, step: 1}}/s/params: {view_stride: 1, step: 1}/params: {}/'
}
run() {  # NAME GRAPH ARGUMENTS...
  local name=$1; shift
  echo "$name" >&2
  "$ppm" run "$@" --threads 1 --out "$out/$name" --force >"$out/$name.log" 2>&1
}
row() {  # NAME LABEL
  jq -r --arg form "$2" 'def r(n): . * n | round / n;
    def ms(k): if .nodes[k] then .nodes[k].ms_mean * .nodes[k].runs / .frames | r(100) else "-" end;
    .holdout as $h | "| \($form) | \($h.coverage | r(10000)) | \($h.median_mm | r(100)) | \($h.within_1cm | r(1000)) / \($h.within_2cm | r(1000)) / \($h.within_5cm | r(1000)) | \($h.mean_trunc20cm_mm | r(100)) | \($h.log_density | r(100)) | \(.map.vertices) | \(.map.bytes / 1048576 | r(100)) | \(ms("look")) | \(ms("update")) |"' \
    "$out/$1/run.json"
}
slam_row() {  # NAME LABEL
  jq -r --arg form "$2" 'def r(n): . * n | round / n;
    (.holdout_estimated // .holdout) as $h | "| \($form) | \(.trajectory.ate_rmse_m * 1000 | r(10)) | \(.trajectory.rpe_trans_rmse_m * 1000 | r(10)) | \($h.median_mm | r(100)) | \(if .revisits then (.revisits.median_mm | r(10)) else "-" end) | \(.map.bytes / 1048576 | r(100)) | \(.fps | r(10)) |"' \
    "$out/$1/run.json"
}

tables() {
  echo "## Mapping with known poses"
  echo
  echo "| | coverage | median, mm | within 1 / 2 / 5 cm | truncated mean, mm | log density | points | MiB | ms view | update |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  for sequence in kitchen icl room; do
    pointed ${sequence}_mapping >"$out/$sequence.yaml"
    for spacing in $([ "$sequence" = kitchen ] && echo 1 2 3 5 || echo 2); do
      run "$sequence-$spacing" "$out/$sequence.yaml" --set "init.spacing=$spacing cm"
      row "$sequence-$spacing" "$sequence, $spacing cm"
    done
  done
  echo
  echo "## SLAM"
  echo
  echo "| | ATE, mm | RPE, mm | held out at estimated poses: median, mm | revisits: median, mm | MiB | frames/s |"
  echo "|---|---|---|---|---|---|---|"
  for sequence in kitchen icl room; do
    local graph=${sequence}_slam
    [ "$sequence" = room ] && graph=room
    registered "$graph" >"$out/$sequence-icp.yaml"
    pointed "$graph" >"$out/$sequence-aligned.yaml"
  done
  run kitchen-icp-300 "$out/kitchen-icp.yaml" --frames 300
  slam_row kitchen-icp-300 "kitchen, first 300 frames, motion.icp"
  run kitchen-icp-point "$out/kitchen-icp.yaml" --set motion.error=point
  slam_row kitchen-icp-point "kitchen, motion.icp, point to point"
  run kitchen-icp-trim "$out/kitchen-icp.yaml" --set motion.trim=0.1
  slam_row kitchen-icp-trim "kitchen, motion.icp, the worst 10 % of the pairs left out"
  for sequence in kitchen icl room; do
    run "$sequence-icp" "$out/$sequence-icp.yaml"
    slam_row "$sequence-icp" "$sequence, motion.icp"
    run "$sequence-aligned" "$out/$sequence-aligned.yaml"
    slam_row "$sequence-aligned" "$sequence, motion.aligned, 4 particles and more by need"
  done
}

sed '/^## Mapping with known poses/,$d' "$page" >"$out/page.md"
tables >>"$out/page.md"
mv "$out/page.md" "$page"
