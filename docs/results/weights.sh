#!/usr/bin/env bash
# Draws particles from the motion prior on kitchen, weighs them in many ways, and rewrites the tables and the plot of weights.md.
#   bash docs/results/weights.sh [FRAMES [PARTICLES]]     default: 1000 300
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
data=${PPM_DATA:-../shared/data}
out=runs/weights
page=docs/results/weights.md
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

"$(dirname "$ppm")/true_pose_weight" "$data/kitchen" "${1:-1000}" "${2:-300}" >"$out/weights.csv"
sed '/^<!-- tables -->$/q' "$page" >"$page.part"
/usr/bin/python3 docs/results/weights.py "$out/weights.csv" docs/images/weights.png >>"$page.part"
mv "$page.part" "$page"
echo "wrote $page"
