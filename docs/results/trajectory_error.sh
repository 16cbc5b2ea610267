#!/usr/bin/env bash
# Compares `ppm evaluate trajectory` with an independent implementation of the public definitions, on the paths of real runs,
# and rewrites trajectory_error.md.
#   bash docs/results/trajectory_error.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
python=${PYTHON:-/usr/bin/python3}
out=runs/trajectory_error
page=docs/results/trajectory_error.md
mkdir -p "$out"

"$ppm" run configs/kitchen_mapping.yaml --set camera.stride=1 --set camera.held_out=followed --out "$out/reference" --quiet
"$ppm" run configs/kitchen_slam.yaml --set init.particles=20 --out "$out/estimated" --quiet
# Half of the poses, and stamps that are off by up to 14 ms: association counts.
awk 'NR % 2 { printf "%.6f", $1 + 0.002 * (NR % 15) - 0.014; for (i = 2; i <= 8; ++i) printf " %s", $i; print "" }' \
  "$out/estimated/trajectory.tum" >"$out/jittered.tum"

for path in estimated/trajectory estimated/trajectory_online jittered; do
  "$ppm" evaluate trajectory "$out/$path.tum" "$out/reference/trajectory.tum" --json >"$out/ppm.json"
  "$python" docs/results/trajectory_error.py "$out/$path.tum" "$out/reference/trajectory.tum" >"$out/numpy.json"
  jq -nc --arg path "$(basename "$path")" --slurpfile ppm "$out/ppm.json" --slurpfile numpy "$out/numpy.json" \
    '{path: $path, ppm: $ppm[0].trajectory, numpy: $numpy[0]}'
done >"$out/compared.jsonl"

"$python" - "$out/compared.jsonl" >"$page" <<'PY'
import json, sys

runs = [json.loads(line) for line in open(sys.argv[1])]
print("""# Trajectory errors against the public definitions

Written by `bash docs/results/trajectory_error.sh`: the paths of a SLAM run over `kitchen` (20 particles) against the data set's poses; `jittered` has
every second pose of the final path, with stamps that are off by up to 14 ms. `paper`: a [script of its own](trajectory_error.py) in numpy, of
the definitions of Sturm et al. (IROS 2012), section IV; `tools`: the same as the TUM RGB-D benchmark's evaluate_ate.py and
evaluate_rpe.py (`--fixed_delta --delta 1 --delta_unit f`) compose them. [Why the last column differs in the relative errors](../metrics.md#trajectory).

| path | | ppm evaluate trajectory | paper | tools |
|---|---|---|---|---|""")
worst = 0
for run in runs:
    for key in run["ppm"]:
        values = run["ppm"][key], run["numpy"]["paper"][key], run["numpy"]["tools"][key]
        worst = max(worst, abs(values[0] - values[1]) / abs(values[1]))
        print(f"| {run['path']} | `{key}` | " + " | ".join(f"{v:.12g}" for v in values) + " |")
print(f"\nThe largest relative difference between `ppm` and `paper` is {worst:.1e}: that of the order of sums.")
PY
cat "$page"
