#!/usr/bin/env bash
# Times every back-end on this machine and compares what they answer; rewrites views.md and its pictures.
#   bash docs/results/views.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
agreement=$(dirname "$ppm")/test_prediction
out=runs/views
page=docs/results/views.md
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

echo "ppm bench" >&2
"$ppm" bench --json "$out/bench.json" >"$out/bench.txt"
"$ppm" bench --texel-size "2 cm" --filter '^(weigh|frame)/prediction.raster/(weigh|.*/texels/).*triangles:(20|100)000' --json "$out/bench_fine.json" \
  >"$out/bench_fine.txt"
"$agreement" "[.table]" | grep '^|' >"$out/agreement.md"
/usr/bin/python3 docs/results/views.py "$out/bench.json" "$out/bench_fine.json" "$out/agreement.md" "$out" >"$page.part"
mv "$out"/views_*.png docs/images/
mv "$page.part" "$page"
echo "wrote $page"
