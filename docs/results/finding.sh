#!/usr/bin/env bash
# How the filter finds its way: accuracy, large steps, where one hypothesis fails, and the literal filter. Rewrites the tables of finding.md.
#   bash docs/results/finding.sh [PART ...]     default: accuracy strides hard literal (about an hour on 2 cores; runs that are there are kept)
#   FINDING_SEEDS (20) and FINDING_PARTICLES (100) make `hard` shorter.
set -euo pipefail
cd "$(dirname "$0")/../.."
export PPM_DATA=${PPM_DATA:-../shared/data}
out=runs/finding
page=docs/results/finding.md
for data in kitchen icl_kt3 house.ply; do
  [ -e "$PPM_DATA/$data" ] || { echo "no $data under $PPM_DATA (set PPM_DATA)" >&2; exit 2; }
done
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

for part in "${@:-accuracy strides hard literal}"; do
  for name in $part; do
    python3 docs/results/finding.py "${PPM:-build/bin/ppm}" "$out/runs" "$name" >"$out/$name.part"
    mv "$out/$name.part" "$out/$name.md"
  done
done
sed '/^<!-- tables -->$/q' "$page" >"$page.part"
for name in accuracy strides hard literal; do
  [ ! -f "$out/$name.md" ] || { echo; cat "$out/$name.md"; } >>"$page.part"
done
mv "$page.part" "$page"
echo "wrote $page"
