#!/usr/bin/env bash
# Runs the main job on the embedded room and on the real sequences that are present, and rewrites main_job.md.
#   bash docs/results/main_job.sh [SEEDS]     SEEDS: for example "1 2 3" (default "7")
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
data=${PPM_DATA:-../shared/data}
out=runs/results
bench=$(dirname "$ppm")/bench_belief
page=docs/results/main_job.md
seeds=${1:-7}
mkdir -p "$out"

run() {  # NAME ARGUMENTS...: runs ppm run into $out/NAME
  local name=$1; shift
  echo "ppm run $* --out $out/$name" >&2
  "$ppm" run "$@" --out "$out/$name" --force >"$out/$name.log" 2>&1
}
field() { jq -r "$2 | if . == null then \"-\" elif type == \"number\" then (. * ($3) | round / ($3) | tostring) else tostring end" "$out/$1/run.json"; }
command_line() { printf '    ppm run %s\n' "$*"; }

mapping_row() {
  echo "| $1 | $(field $1 .frames 1) | $(field $1 .holdout.coverage 10000) | $(field $1 .holdout.median_mm 100) |" \
    "$(field $1 .holdout.within_1cm 1000) / $(field $1 .holdout.within_2cm 1000) / $(field $1 .holdout.within_5cm 1000) |" \
    "$(field $1 .holdout.mean_trunc20cm_mm 10) | $(field $1 .holdout.log_density 1000) | $(field $1 .map.faces 1) / $(field $1 .map.texels 1) |" \
    "$(field $1 '.map.bytes / 1048576' 100) | $(field $1 .fps 10) |"
}
slam_row() {
  echo "| $1 | $2 | $(field $1 .frames 1) | $(field $1 .particles 1) | $(field $1 .trajectory.ate_rmse_m 10000) |" \
    "$(field $1 .trajectory.rpe_trans_rmse_m 10000) / $(field $1 .trajectory.rpe_rot_rmse_deg 1000) |" \
    "$(field $1 .holdout.coverage 1000) / $(field $1 .holdout.median_mm 10) |" \
    "$(field $1 '.map.bytes_owned_total / 1048576' 10) / $(field $1 '.map.bytes_shared_total / 1048576' 10) | $(field $1 .fps 10) |"
}

{
  echo "# The main job on the room and on real frames"
  echo
  echo "Written by \`bash docs/results/main_job.sh \"$seeds\"\`. Machine: $(nproc) cores, $(sed -n 's/^model name.*: //p' /proc/cpuinfo | head -1)."
  echo "Definitions: [metrics](../metrics.md). Two cores, nothing else running."
} >"$page.part"

if [ -d "$data/kitchen" ]; then
  run kitchen_300 configs/kitchen_mapping.yaml --set camera.last=299
  run kitchen_all configs/kitchen_mapping.yaml
  {
    echo
    echo "## Mapping with the reference poses"
    echo
    echo "| run | frames mapped | coverage | median, mm | within 1 / 2 / 5 cm | truncated mean, mm | log density | faces / texels | MiB | frames/s |"
    echo "|---|---|---|---|---|---|---|---|---|---|"
    mapping_row kitchen_300
    mapping_row kitchen_all
    echo
    command_line configs/kitchen_mapping.yaml --set camera.last=299
    command_line configs/kitchen_mapping.yaml
    echo
    echo "![The kitchen, all frames](../images/kitchen.png)"
  } >>"$page.part"
fi

{
  echo
  echo "## SLAM"
  echo
  echo "Held-out depth here is predicted from the reference poses, moved into the map by the alignment of the trajectory."
  echo
  echo "| run | seed | frames | particles | ATE, m | RPE, m / deg | held-out coverage / median, mm | maps, MiB owned / saved by sharing | frames/s |"
  echo "|---|---|---|---|---|---|---|---|---|"
} >>"$page.part"
for seed in $seeds; do
  run room_$seed configs/room.yaml --seed $seed
  slam_row room_$seed $seed >>"$page.part"
  if [ -d "$data/kitchen" ]; then
    for graph in kitchen_slam_paper kitchen_slam_motion kitchen_slam; do
      run ${graph}_$seed configs/$graph.yaml --seed $seed --set camera.last=299
      slam_row ${graph}_$seed $seed >>"$page.part"
    done
  fi
  if [ -d "$data/icl_kt3" ]; then
    run icl_slam_$seed configs/icl_slam.yaml --seed $seed
    slam_row icl_slam_$seed $seed >>"$page.part"
  fi
done
memory_rows() {  # NAME: what the maps of all particles occupy, over the run
  awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
    $column["table.map_bytes_owned"] != "" && $1 % 30 == 0 {
      owned = $column["table.map_bytes_owned"] / 1048576; alone = $column["table.map_bytes_alone"] / 1048576
      printf "| %d | %.1f | %.1f | %.1f %% |\n", $1, owned, alone, 100 * owned / alone
    }' "$out/$1/metrics.csv"
}
{
  echo
  command_line configs/room.yaml --seed SEED
  command_line configs/kitchen_slam_paper.yaml --seed SEED --set camera.last=299
  command_line configs/kitchen_slam_motion.yaml --seed SEED --set camera.last=299
  command_line configs/kitchen_slam.yaml --seed SEED --set camera.last=299
  command_line configs/icl_slam.yaml --seed SEED
  echo
  echo "## What sharing saves"
  echo
  first=room_${seeds%% *}
  [ -d "$data/kitchen" ] && first=kitchen_slam_motion_${seeds%% *}
  echo "Memory of the maps of all 100 particles in the run \`$first\`, against what they would occupy each for itself."
  echo
  echo "| frame | owned, MiB | without sharing, MiB | share |"
  echo "|---|---|---|---|"
  memory_rows "$first"
  echo
  echo "## Same bytes for any number of threads"
  echo
  echo "| threads | digest, room, 30 frames |"
  echo "|---|---|"
} >>"$page.part"
for threads in 1 2 4; do
  run threads_$threads configs/room.yaml --frames 30 --threads $threads
  echo "| $threads | \`$(field threads_$threads .digest 1)\` |" >>"$page.part"
done
{
  echo
  command_line configs/room.yaml --frames 30 --threads N
  if [ -x "$bench" ]; then
    echo
    echo "## What copying a particle costs"
    echo
    echo "A map of 2,000 chunks; \`gather/N\` resamples N particles, \`first_edit_of_a_copy/K\` writes texels of K chunks of a map that others share."
    echo
    echo "| case | µs of CPU |"
    echo "|---|---|"
    "$bench" --benchmark_format=csv 2>/dev/null | awk -F, 'NR > 1 { gsub(/"/, "", $1); printf "| `%s` | %.4g |\n", $1, $4 }'
    echo
    echo "    bench_belief"
  fi
} >>"$page.part"
mv "$page.part" "$page"
echo "wrote $page"
