#!/usr/bin/env bash
# Maps the kitchen with and without simplification, and rewrites simplify.md and its pictures.
#   bash docs/results/simplify.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
out=runs/simplify
page=docs/results/simplify.md
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

# NAME MODULE WHEN ARGUMENTS...: the kitchen's graph with that module as node `thin` (none: without it), and a report of its surface
run() {
  local name=$1 module=$2 when=$3 graph=$out/$1.yaml; shift 3
  sed -e '/name: thin,/d; /name: image,/d' configs/kitchen_mapping.yaml >"$graph"
  [ "$module" = none ] || sed -i "s|^  - {name: path,|  - {name: thin, module: $module, when: {$when}}\n&|" "$graph"
  sed -i 's|module: sink.mesh_ply,|& params: {surface: base},|' "$graph"
  echo "  - {name: surface, module: sink.surface_report, in: {frame: camera.frame}, when: {at_end: true}}" >>"$graph"
  echo "ppm run $graph $*" >&2
  "$ppm" run "$graph" --threads 1 --out "$out/$name" --force "$@" >"$out/$name.log" 2>&1
}
row() {  # LABEL NAME
  jq -r --arg label "$1" --slurpfile s "$out/$2/surface.json" '
    def r(n): . * n | round / n;
    "| \($label) | \(.holdout.coverage | r(10000)) | \(.holdout.median_mm | r(100)) | " +
    "\(.holdout.within_1cm | r(1000)) / \(.holdout.within_2cm | r(1000)) / \(.holdout.within_5cm | r(1000)) | " +
    "\(.holdout.mean_trunc20cm_mm | r(100)) | \(.holdout.log_density | r(100)) | \($s[0].second_layers | r(10000)) | " +
    "\($s[0].boundary_edges_per_m2 | round) | \(.map.faces) / \(.map.texels) | \(.map.bytes / 1048576 | r(100)) | " +
    "\(if .nodes.thin then .nodes.thin.ms_mean * .nodes.thin.runs / .frames | r(100) else "-" end) |"' "$out/$2/run.json"
}
run plain none ""
run meshopt simplify.meshoptimizer "every: 250"
run openmesh simplify.openmesh_qem "every: 250"
run often simplify.meshoptimizer "every: 50"
for e in 2 8 16; do run "error_$e" simplify.meshoptimizer "every: 250" --set "thin.error=$e mm"; done
run texel_4 simplify.meshoptimizer "every: 250" --set "init.texel_size=4 cm"

{
  echo "# Fewer faces for the same surface"
  echo
  echo "Written by \`bash docs/results/simplify.sh\`: \`configs/kitchen_mapping.yaml\` (500 images mapped, 100 held out, one thread), with one line"
  echo "\`{name: thin, module: ..., when: {every: N}}\` after the update. How it works: [simplify](../simplify.md). Time: of the node, over all frames."
  echo
  echo "| run | coverage | median, mm | within 1 / 2 / 5 cm | truncated mean, mm | log density | second layers | open edges / m2 | faces / texels | MiB | ms a frame |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|"
  row "nothing simplified" plain
  row "\`simplify.meshoptimizer\`, every 250" meshopt
  row "\`simplify.openmesh_qem\`, every 250" openmesh
  row "meshoptimizer, every 50" often
  for e in 2 8 16; do row "meshoptimizer, every 250, \`error: $e mm\`" "error_$e"; done
  row "meshoptimizer, every 250, \`texel_size: 4 cm\`" texel_4
  echo
  echo "![Before and after](../images/simplify_wire.png)"
} >"$page.part"
mv "$page.part" "$page"

/usr/bin/python3 - docs/images/simplify_wire.png "$out/plain/map.ply" "$out/meshopt/map.ply" <<'PYTHON'
import sys
import numpy as np
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

def read(path):  # as sink.mesh_ply writes it
    with open(path, "rb") as file:
        counts, floats = {}, 0
        for line in iter(lambda: file.readline().split(), [b"end_header"]):
            if line[0] == b"element": counts[line[1]] = int(line[2])
            if line[:2] == [b"property", b"float"]: floats += 1
        vertices = np.fromfile(file, "<f4", counts[b"vertex"] * floats).reshape(-1, floats)[:, :3]
        faces = np.fromfile(file, np.dtype([("n", "u1"), ("v", "<i4", 3)]), counts[b"face"])["v"]
    return vertices, faces

figure, axes = plt.subplots(1, 2, figsize=(13, 6), constrained_layout=True)
for axis, path, title in zip(axes, sys.argv[2:], ("as mapped", "simplified")):
    vertices, faces = read(path)
    axis.triplot(vertices[:, 0], vertices[:, 1], faces, lw=0.25, color="k")
    axis.set(title=f"{title}: {len(faces)} faces", xlim=(-1.2, 1.2), ylim=(1.0, -1.0), aspect="equal", xticks=[], yticks=[])
figure.savefig(sys.argv[1], dpi=100)
PYTHON
