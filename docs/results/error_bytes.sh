#!/usr/bin/env bash
# Error against bytes on the kitchen, for the mesh at several levels of detail and for grids of several resolutions;
# rewrites error_bytes.md and docs/images/error_bytes.png. The grids need a build with -DPPM_GRIDS=ON (liboctomap-dev,
# libopen3d-dev); without their programs their last figures, kept in error_bytes.grids.jsonl, are used.
#   bash docs/results/error_bytes.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
bin=$(dirname "$ppm")
export PPM_DATA=${PPM_DATA:-../shared/data}
out=runs/error_bytes
page=docs/results/error_bytes.md
grids=docs/results/error_bytes.grids.jsonl
mkdir -p "$out"
source="{path: $PPM_DATA/kitchen, stride: 2, pixel_stride: 2, holdout: every 10th}"

: >"$out/ppm.jsonl"
level() {  # NAME OVERRIDES...
  local name=$1; shift
  local overrides=()
  for o in "$@"; do overrides+=(--set "$o"); done
  echo "ppm run configs/kitchen_mapping.yaml ${overrides[*]}" >&2
  "$ppm" run configs/kitchen_mapping.yaml "${overrides[@]}" --out "$out/$name" --force >"$out/$name.log" 2>&1
  jq -c --arg name "$*" '{name: $name, bytes: .map.bytes, faces: .map.faces, texels: .map.texels} + .holdout' "$out/$name/run.json" >>"$out/ppm.jsonl"
}
level t1 "init.texel_size=1 cm"
level t2 "init.texel_size=2 cm"
level t4 "init.texel_size=4 cm"
level t8 "init.texel_size=8 cm"
level t8f "init.texel_size=8 cm" "update.leaf_min=4"
level t16f "init.texel_size=16 cm" "update.leaf_min=8"

if [ -x "$bin/grid_octomap" ] && [ -x "$bin/grid_tsdf" ]; then
  : >"$grids.part"
  for r in 0.1 0.05 0.03 0.02; do "$bin/grid_octomap" "$r" source.seven_scenes "$source" >>"$grids.part"; done
  for r in 0.08 0.04 0.02 0.01; do "$bin/grid_tsdf" "$r" source.seven_scenes "$source" >>"$grids.part"; done
  mv "$grids.part" "$grids"
fi

/usr/bin/python3 docs/results/error_bytes.py "$out/ppm.jsonl" "$grids" docs/images/error_bytes.png >"$page.part"
mv "$page.part" "$page"
echo "wrote $page"
