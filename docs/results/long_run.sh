#!/usr/bin/env bash
# SLAM over all 1,000 frames of kitchen with 100 particles: time and memory frame by frame. Rewrites long_run.md and its picture.
#   bash docs/results/long_run.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
data=${PPM_DATA:-../shared/data}
out=runs/long_run
page=docs/results/long_run.md
[ -d "$data/kitchen" ] || { echo "no kitchen under $data (set PPM_DATA)" >&2; exit 2; }
mkdir -p "$out"
trap 'rm -f "$page.part" "$out/page.png"' EXIT

sed -e 's/prediction.embree/prediction.raster/; /name: export,/d; /name: image,/d; /name: mesh,/d' configs/kitchen_slam_motion.yaml >"$out/graph.yaml"
options=(--set camera.holdout=none --set table.memory_every=5)
echo "ppm run $out/graph.yaml ${options[*]} --times" >&2
"$ppm" run "$out/graph.yaml" "${options[@]}" --times --out "$out/run" --force >"$out/run.log" 2>&1 || { cat "$out/run.log" >&2; exit 1; }
"$ppm" run "$out/graph.yaml" "${options[@]}" --set update.keyframe_every=4 --set update.between=nothing --out "$out/sparse" --force \
  >"$out/sparse.log" 2>&1 || { cat "$out/sparse.log" >&2; exit 1; }
/usr/bin/python3 docs/results/long_run.py "$out/run" "$out/sparse" "$out/page.png" >"$page.part"
mv "$out/page.png" docs/images/long_run.png
mv "$page.part" "$page"
echo "wrote $page"
