#!/usr/bin/env bash
# What each setting of the occupancy grid is worth, and its speed; rewrites vdb.md.
#   bash docs/results/vdb.sh        needs the kitchen sequence in $PPM_DATA, and jq
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
bench=$(dirname "$ppm")/bench_vdb_dda
out=runs/results/vdb
page=docs/results/vdb.md
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

run() {  # GRAPH [NODE.KEY=VALUE]...
  local graph=$1 sets=()
  shift
  for s in "$@"; do sets+=(--set "$s"); done
  echo "ppm run configs/$graph.yaml ${sets[*]-}" >&2
  sed '/module: sink\.\(mesh_ply\|export\|image\|map_\|surface\)/d' "configs/$graph.yaml" >"$out/$graph.yaml"
  "$ppm" run "$out/$graph.yaml" --threads 1 --out "$out/run" --force ${sets[@]+"${sets[@]}"} >"$out/log" 2>&1
}
mapped() {  # NAME GRAPH [NODE.KEY=VALUE]...
  local name=$1
  shift
  run "$@"
  jq -r --arg name "$name" '
    def digits(n): . * pow(10; n) | round / pow(10; n) | tostring;
    "| \($name) | \(.holdout.coverage | digits(4)) | \(.holdout.median_mm | digits(2)) | " +
    "\(.holdout.within_1cm | digits(3)) / \(.holdout.within_2cm | digits(3)) / \(.holdout.within_5cm | digits(3)) | " +
    "\(.holdout.mean_trunc20cm_mm | digits(1)) | \(.holdout.log_density | digits(2)) | " +
    "\(.holdout.within_1_sigma | digits(3)) / \(.holdout.within_2_sigma | digits(3)) | " +
    "\(.nodes.update.ms_mean | digits(1)) | \(.map.bytes / 1048576 | digits(1)) |"' "$out/run/run.json"
}
tracked() {  # NAME GRAPH [NODE.KEY=VALUE]...
  local name=$1
  shift
  run "$@"
  jq -r --arg name "$name" '
    def digits(n): . * pow(10; n) | round / pow(10; n) | tostring;
    "| \($name) | \(.trajectory.ate_rmse_m * 100 | digits(2)) | \(.tracking.outlier_share_mean | digits(3)) | " +
    "\(.holdout_estimated.median_mm | digits(2)) | \(.holdout_estimated.log_density | digits(2)) | " +
    "\(.fps | digits(1)) | \(.map.bytes / 1048576 | digits(1)) |"' "$out/run/run.json"
}
mapping_head() {
  echo "| change | coverage | median mm | within 1 / 2 / 5 cm | mean trunc. mm | log density | within 1 / 2 sigma | update, ms a frame | MiB |"
  echo "|---|---|---|---|---|---|---|---|---|"
}

{
  echo "# What each setting of the occupancy grid is worth"
  echo
  echo "Written by \`bash docs/results/vdb.sh\`, one thread. [What the columns mean](../metrics.md)."
  echo "Modules: [update](../modules/map_update.vdb_occupancy.md), [prediction](../modules/prediction.vdb_dda.md)."
  echo
  cat <<'TEXT'
The grid is no straw man: its profile through the measured range makes log odds that cross 0 where the surface is, the memory keeps
their ratio between neighbours from saturating, and the prediction reads that crossing between the cells. What plain grids do
(hits and misses, clamps, the first occupied cell) is in the last line but one: the front face of a cell, half a cell too near and more.
TEXT
  echo
  echo "## Kitchen, reference poses: 500 images of 160x120 mapped, 100 held out"
  echo
  mapping_head
  mapped "**none** (2 cm)" kitchen_mapping_vdb
  for c in update.memory=0 update.memory=30 update.width_voxels=1 update.width_voxels=2 update.thickness_voxels=3 \
    init.log_odds_max=6 look.surface=cell look.surface=expected look.surface_sigma=0 look.surface_sigma=12mm look.cell_sigma=0 look.cell_sigma=0.5 \
    init.voxel_size=5cm init.voxel_size=1cm; do
    mapped "\`${c/=/: }\`" kitchen_mapping_vdb $c
  done
  mapped "as plain grids are: \`model: literal\`, \`surface: cell\`, clamps -2 and 3.5" kitchen_mapping_vdb \
    update.model=literal look.surface=cell init.log_odds_min=-2 init.log_odds_max=3.5
  mapped "PPM, for comparison" kitchen_mapping
  echo
  echo "## Room and ICL-NUIM, reference poses"
  echo
  mapping_head
  for data in room icl; do
    for size in 5cm 2cm; do mapped "$data, $size" ${data}_mapping_vdb init.voxel_size=$size; done
    mapped "$data, PPM" ${data}_mapping
  done
  echo
  echo "## SLAM with the same filter"
  echo
  echo "| run | ATE, cm | outlier share | held-out median mm, estimated poses | log density | frames/s | MiB |"
  echo "|---|---|---|---|---|---|---|"
  tracked "kitchen, grid of 2 cm" kitchen_slam_vdb
  tracked "kitchen, PPM" kitchen_slam
  echo
  echo "## Rays"
  echo
  echo "\`bench_vdb_dda\`, a room of 6 x 5 x 2.7 m, 176x144 pixels, one thread; OpenVDB's own walk finds the first occupied"
  echo "voxel and no more: no surface between the cells, no variance, no normal."
  echo
  echo '```'
  "$bench" --benchmark_min_time=1 2>/dev/null
  echo '```'
} >"$page.part"
mv "$page.part" "$page"
