#!/usr/bin/env bash
# What the map update costs, what keyframes save, and how large chunks should be; rewrites map_update_speed.md.
#   bash docs/results/map_update_speed.sh       needs the kitchen sequence in $PPM_DATA, and bench_update built
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
bench=$(dirname "$ppm")/bench_update
out=runs/results/map_update_speed
mkdir -p "$out"

run() {  # NAME GRAPH ARGUMENTS...
  local name=$1 graph=$2
  shift 2
  "$ppm" run "configs/$graph.yaml" --threads 1 --out "$out/$name" --force "$@" >"$out/$name.log" 2>&1
}
policy() { echo --set "update.keyframe_every=$1" --set "update.between=$2"; }
slam() {  # NAME SEED ARGUMENTS...
  local name=$1 seed=$2
  shift 2
  run "$name" kitchen_slam --seed "$seed" --set camera.last=299 "$@"
}

"$bench" --benchmark_repetitions=3 --benchmark_report_aggregates_only=true --benchmark_out="$out/bench.json" \
  --benchmark_out_format=json >/dev/null
for p in "1 texels" "2 texels" "2 nothing" "4 texels" "4 nothing" "8 texels" "8 nothing"; do
  run "map_${p/ /_}" kitchen_mapping $(policy $p)
done
for seed in 7 8 9; do
  for p in "1 texels" "4 texels" "4 nothing"; do slam "slam_${p/ /_}_$seed" "$seed" $(policy $p); done
done
for cell in 25cm 50cm 1m 2m; do slam "cell_$cell" 7 --set "init.cell_size=$cell"; done
python3 docs/results/map_update_speed.py "$out" >docs/results/map_update_speed.md.part
mv docs/results/map_update_speed.md.part docs/results/map_update_speed.md
