#!/usr/bin/env bash
# The planned ways through the simulated house, each mapped with known poses. Rewrites house_plans.md and its pictures.
#   bash docs/results/house_plans.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
export PPM_DATA=${PPM_DATA:-../shared/data}
out=runs/house_plans
page=docs/results/house_plans.md
[ -f "$PPM_DATA/house.ply" ] || { echo "no house.ply under $PPM_DATA (set PPM_DATA)" >&2; exit 2; }
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

for plan in loop tour corridor fast_turn kidnap; do
  echo "ppm run configs/house_mapping.yaml --set camera.plan=$plan" >&2
  "$ppm" run configs/house_mapping.yaml --set "camera.plan=$plan" --out "$out/$plan" --force >"$out/$plan.log" 2>&1 ||
    { cat "$out/$plan.log" >&2; exit 1; }
done
/usr/bin/python3 docs/results/house_plans.py "$PPM_DATA/house.ply" "$out" docs/images/house_plans.png >"$page.part"
convert "$out/tour/map.png" -resize 960x -colors 96 -define png:compression-level=9 docs/images/house_tour.png
mv "$page.part" "$page"
echo "wrote $page"
