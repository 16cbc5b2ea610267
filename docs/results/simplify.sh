#!/usr/bin/env bash
# Maps with and without simplification, and rewrites simplify.md and its picture.
#   bash docs/results/simplify.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
out=runs/simplify
page=docs/results/simplify.md
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

# NAME GRAPH MODULE WHEN ARGUMENTS...: runs that graph with the module as node `thin` (none: without it)
run() {
  local name=$1 source=$2 module=$3 when=$4 graph=$out/$1.yaml; shift 4
  sed -e '/name: thin,/d; /name: image,/d; /name: export,/d' "configs/$source.yaml" >"$graph"
  [ "$module" = none ] || sed -i "s|^  - {name: path,|  - {name: thin, module: $module, when: {$when}}\n&|" "$graph"
  sed -i 's|module: sink.mesh_ply,|& params: {surface: base},|' "$graph"
  echo "ppm run $graph $*" >&2
  "$ppm" run "$graph" --threads 1 --out "$out/$name" --force "$@" >"$out/$name.log" 2>&1
}
row() {  # LABEL NAME
  jq -r --arg text "$1" --slurpfile s "$out/$2/surface.json" '
    def r(n): . * n | round / n;
    "| \($text) | \(.holdout.coverage | r(10000)) | \(.holdout.median_mm | r(100)) | " +
    "\(.holdout.within_1cm | r(1000)) / \(.holdout.within_2cm | r(1000)) / \(.holdout.within_5cm | r(1000)) | " +
    "\(.holdout.mean_trunc20cm_mm | r(100)) | \(.holdout.log_density | r(100)) | \($s[0].second_layers | r(10000)) | " +
    "\($s[0].boundary_edges_per_m2 | round) | \(.map.faces) / \(.map.texels) | \(.map.bytes / 1048576 | r(100)) | " +
    "\(if .nodes.thin then .nodes.thin.ms_mean * .nodes.thin.runs / .frames | r(100) else "-" end) |"' "$out/$2/run.json"
}
run plain kitchen_mapping none ""
run meshopt kitchen_mapping simplify.meshoptimizer "every: 100"
run openmesh kitchen_mapping simplify.openmesh_qem "every: 100"
run often kitchen_mapping simplify.meshoptimizer "every: 25"
run error_2 kitchen_mapping simplify.meshoptimizer "every: 100" --set "thin.error=2 mm" --set thin.sigmas=0
run error_8 kitchen_mapping simplify.meshoptimizer "every: 100" --set "thin.error=8 mm" --set thin.sigmas=1
run base_10 kitchen_mapping simplify.meshoptimizer "every: 100" --set "thin.error_base=10 mm"
for graph in room icl; do
  run "${graph}_plain" "${graph}_mapping" none ""
  run "${graph}_meshopt" "${graph}_mapping" simplify.meshoptimizer "every: 50"
done

{
  echo "# Fewer faces for the same surface"
  echo
  echo "Written by \`bash docs/results/simplify.sh\`: graphs of \`configs\` (every tenth image held out, one thread) with and without the line"
  echo "\`{name: thin, module: simplify.meshoptimizer, when: {every: N}}\` after the update. How it works: [simplify](../simplify.md). Time: of the node, over all frames."
  echo
  echo "| run | coverage | median, mm | within 1 / 2 / 5 cm | truncated mean, mm | log density | second layers | open edges / m2 | faces / texels | MiB | ms a frame |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|"
  row "\`kitchen_mapping\`, nothing simplified" plain
  row "\`simplify.meshoptimizer\`, every 100" meshopt
  row "\`simplify.openmesh_qem\`, every 100" openmesh
  row "meshoptimizer, every 25" often
  row "meshoptimizer, every 100, \`error: 2 mm, sigmas: 0\`" error_2
  row "meshoptimizer, every 100, \`error: 8 mm, sigmas: 1\`" error_8
  row "meshoptimizer, every 100, \`error_base: 10 mm\`" base_10
  for graph in room icl; do
    row "\`${graph}_mapping\`, nothing simplified" "${graph}_plain"
    row "\`simplify.meshoptimizer\`, every 50" "${graph}_meshopt"
  done
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
convert docs/images/simplify_wire.png -resize 70% -colorspace Gray -colors 8 docs/images/simplify_wire.png
