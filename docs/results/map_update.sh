#!/usr/bin/env bash
# What each parameter of map_update.ppm_bayes is worth: one run of the kitchen a change; rewrites map_update.md.
#   bash docs/results/map_update.sh        needs the kitchen sequence in $PPM_DATA, and jq
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
out=runs/results/map_update
page=docs/results/map_update.md
mkdir -p "$out"

row() {  # NAME [NODE.KEY=VALUE]...
  local name=$1 sets=()
  shift
  for s in "$@"; do sets+=(--set "$s"); done
  "$ppm" run configs/kitchen_mapping.yaml --threads 1 --out "$out/run" --force ${sets[@]+"${sets[@]}"} >"$out/log" 2>&1
  jq -r --arg name "$name" --slurpfile surface "$out/run/surface.json" '
    def digits(n): . * pow(10; n) | round / pow(10; n) | tostring;
    "| \($name) | \(.holdout.coverage | digits(4)) | \(.holdout.median_mm | digits(2)) | " +
    "\(.holdout.within_1cm | digits(3)) / \(.holdout.within_2cm | digits(3)) / \(.holdout.within_5cm | digits(3)) | " +
    "\(.holdout.mean_trunc20cm_mm | digits(1)) | \(.holdout.log_density | digits(2)) | " +
    "\($surface[0].second_layers | digits(4)) | \($surface[0].boundary_edges_per_m2 | round) | " +
    "\(.map.faces / 1000 | digits(1))k / \(.map.texels / 1000 | round)k | \(.map.bytes / 1048576 | digits(2)) |"' "$out/run/run.json"
}
change() {  # KEY=VALUE of the update, or NODE.KEY=VALUE
  local set=$1
  [[ ${set%%=*} == *.* ]] || set=update.$set
  row "\`${1/=/: }\`" "$set"
}

{
  echo "# What each parameter of the map update is worth"
  echo
  echo "Written by \`bash docs/results/map_update.sh\`: \`ppm run configs/kitchen_mapping.yaml --threads 1 --set update.KEY=VALUE\`,"
  echo "500 images of 160x120 mapped with the reference poses, 100 held out. [What the columns mean](../metrics.md);"
  echo "[what the parameters do](../map_update.md). Differences of the median below 0.03 mm are chance."
  echo
  echo "| change | coverage | median mm | within 1 / 2 / 5 cm | mean trunc. mm | log density | second layers | open edges / m2 | faces / texels | MiB |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  row "**none**"
  for c in update=scatter new_texels=sensor gate_classify=4 gate_pose=5mm gate_pose=2cm gate_update=2 \
    thin_every=0 leaf_min=1 leaf_max=4 leaf_rms=3 leaf_valid=0.8 smooth_radius=0 fit_share=0.9 own_share=0.2 \
    cosine_least=0.15 grazing_every=0 grazing_every=5 excess=none steep_cosine=0 hole_edges=0 notch_angle=0 \
    votes_ratio=0.5 votes_ratio=2 votes_free=65535 votes_cosine=0 votes_forget=0 \
    texel_pixels=0 texel_pixels=2 init.texel_size=1cm init.texel_size=4cm init.cell_size=50cm; do
    change "$c"
  done
} >"$page.part"
mv "$page.part" "$page"
