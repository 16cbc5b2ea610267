#!/usr/bin/env bash
# Runs the mapping graphs with and without refinement, in several forms, and rewrites the tables of refinement.md and its picture.
#   bash docs/results/refinement.sh     PYTHON: one that has matplotlib (default python3)
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
data=${PPM_DATA:-../shared/data}
out=runs/refinement
page=docs/results/refinement.md
mkdir -p "$out"

adjust() { printf '  - {name: adjust, module: refinement.vertex_adjust, when: {%s}, params: {%s}}\n' "$1" "$2"; }
remesh() { printf '  - {name: remesh, module: refinement.remesh, when: {%s}, params: {%s}}\n' "$1" "$2"; }

# variant SEQUENCE NAME NODES: the sequence's mapping graph up to its update, then nodes, run
variant() {
  local graph=$out/$1-$2.yaml
  { sed '/name: path,/,$d' "configs/$1_mapping.yaml" | grep -v 'module: refinement'
    printf '%s' "$3"; } >"$graph"
  run "$1-$2" "$graph"
}
run() {  # NAME GRAPH ARGUMENTS...
  local name=$1; shift
  echo "$name" >&2
  "$ppm" run "$@" --threads 1 --out "$out/$name" --force >"$out/$name.log" 2>&1
}
row() {  # NAME LABEL
  jq -r --arg form "$2" 'def r(n): . * n | round / n;
    def ms(k): if .nodes[k] then .nodes[k].ms_mean * .nodes[k].runs / .frames | r(100) else "-" end;
    .holdout as $h | "| \($form) | \($h.coverage | r(10000)) | \($h.median_mm | r(100)) | \($h.within_1cm | r(10000)) / \($h.within_2cm | r(10000)) / \($h.within_5cm | r(10000)) | \($h.mean_trunc20cm_mm | r(100)) | \($h.log_density | r(1000)) | \(.map.faces) / \(.map.texels) | \(.map.bytes / 1048576 | r(100)) | \(ms("look")) | \(ms("update")) | \(ms("adjust")) | \(ms("remesh")) |"' \
    "$out/$1/run.json"
}
header() {
  echo
  echo "| | coverage | median, mm | within 1 / 2 / 5 cm | truncated mean, mm | log density | faces / texels | MiB | ms view | update | adjust | remesh |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|"
}

table() {  # SEQUENCE: the forms worth comparing everywhere
  variant "$1" none ""
  variant "$1" adjust_10 "$(adjust 'every: 10' '')"$'\n'
  variant "$1" adjust_1 "$(adjust '' '')"$'\n'
  variant "$1" remesh_10 "$(remesh 'every: 10' '')"$'\n'
  variant "$1" both "$(adjust 'every: 10' '')"$'\n'"$(remesh 'every: 10' '')"$'\n'
  header
  row "$1-none" "without"
  row "$1-adjust_10" "adjust every 10th frame"
  row "$1-adjust_1" "adjust in every frame"
  row "$1-remesh_10" "remesh every 10th frame"
  row "$1-both" "both every 10th frame"
}
forms() {  # SEQUENCE: the paper's forms, and what single choices are worth
  local all='offset_sigmas: 0, offset_least: 0, mean: plain, boundary: move'
  variant "$1" plain "$(adjust '' "$all")"$'\n'
  variant "$1" keep "$(adjust '' "$all, texels: keep")"$'\n'
  variant "$1" boundary "$(adjust '' 'boundary: move')"$'\n'
  variant "$1" error1 "$(remesh 'every: 10' 'error_least: 1 cm')"$'\n'
  variant "$1" insert "$(remesh 'every: 10' 'error: offset, split: insert, turn_most: 80 deg')"$'\n'
  header
  row "$1-plain" "adjust every vertex in every frame, plain mean, boundary too"
  row "$1-keep" "the same, \`texels: keep\`"
  row "$1-boundary" "adjust in every frame, \`boundary: move\`"
  row "$1-error1" "remesh every 10th, \`error_least: 1 cm\`"
  row "$1-insert" "remesh every 10th, the paper's form"
}
pictures() {  # one pass of each at the end of icl_kt3
  local mesh='  - {name: mesh, module: sink.mesh_ply, when: {at_end: true}, params: {surface: base}}'
  local path='  - {name: path, module: sink.trajectory_tum}'
  variant icl drawn_none "$path"$'\n'"$mesh"$'\n'
  variant icl drawn_adjust "$(adjust 'at_end: true' 'offset_least: 2 mm, offset_sigmas: 1')"$'\n'"$path"$'\n'"$mesh"$'\n'
  variant icl drawn_remesh "$(remesh 'at_end: true' 'error_least: 1 cm')"$'\n'"$path"$'\n'"$mesh"$'\n'
  "${PYTHON:-python3}" docs/results/refinement_pictures.py docs/images/refinement.png "$out/icl-drawn_none/trajectory.tum" 30 0.752,-1.0 \
    "before=$out/icl-drawn_none/map.ply" "vertices moved=$out/icl-drawn_adjust/map.ply" "vertices inserted=$out/icl-drawn_remesh/map.ply"
}

{
  sed '/^## The embedded room/,$d' "$page"  # what stands above the tables is written by hand
  echo "## The embedded room"
  table room
  if [ -d "$data/icl_kt3" ]; then
    echo
    echo "## \`icl_kt3\`"
    table icl
    pictures
    echo
    echo "![The mesh before and after one pass of each](../images/refinement.png)"
    echo
    echo "A wall, before, after one pass that moves vertices, and after one that inserts them. Colour: offset of the described surface from the face."
    echo "Inserting alone, with nothing moved before, leaves the offsets at the old corners: the row of faces at the step above is finer, not nearer."
  fi
  if [ -d "$data/kitchen" ]; then
    echo
    echo "## \`kitchen\`"
    table kitchen
    echo
    echo "## Forms, on \`kitchen\`"
    forms kitchen
    run kitchen-paper configs/kitchen_mapping_paper.yaml
    row kitchen-paper "\`kitchen_mapping_paper.yaml\`"
  fi
} >"$page.part"
mv "$page.part" "$page"
