#!/usr/bin/env bash
# Error against bytes on the kitchen, for the mesh at several levels of detail and for grids of several resolutions;
# rewrites error_bytes.md and docs/images/error_bytes.png. The grids are plug-ins (`bash apps/install_packages.sh
# --optional`); where they are not built, their last figures, kept in error_bytes.grids.jsonl, are used.
#   bash docs/results/error_bytes.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
export PPM_DATA=${PPM_DATA:-../shared/data}
out=runs/error_bytes
page=docs/results/error_bytes.md
grids=docs/results/error_bytes.grids.jsonl
mkdir -p "$out"

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

grid() {  # KIND NAME RESOLUTION_CM OVERRIDES...
  local kind=$1 name=$2 cm=$3; shift 3
  local overrides=(--set "init.voxel_size=$cm cm")
  for o in "$@"; do overrides+=(--set "$o"); done
  echo "ppm run configs/kitchen_mapping_$kind.yaml ${overrides[*]}" >&2
  "$ppm" run "configs/kitchen_mapping_$kind.yaml" "${overrides[@]}" --threads 1 --out "$out/$kind$cm" --force >"$out/$kind$cm.log" 2>&1
  jq -c --arg map "$name" --argjson cm "$cm" \
    '{map: $map, resolution_m: ($cm / 100), frames, bytes: .map.bytes, update_ms: .nodes.update.ms_mean} + .holdout' "$out/$kind$cm/run.json" >>"$grids.part"
}
if "$ppm" check configs/kitchen_mapping_octomap.yaml >/dev/null 2>&1 && "$ppm" check configs/kitchen_mapping_tsdf.yaml >/dev/null 2>&1; then
  : >"$grids.part"
  for cm in 10 5 3 2; do grid octomap OctoMap "$cm"; done
  for cm in 8 4 2 1; do grid tsdf TSDF "$cm" "init.truncation=$((cm > 1 ? 4 * cm : 4)) cm"; done
  mv "$grids.part" "$grids"
fi

/usr/bin/python3 docs/results/error_bytes.py "$out/ppm.jsonl" "$grids" docs/images/error_bytes.png >"$page.part"
mv "$page.part" "$page"
echo "wrote $page"
