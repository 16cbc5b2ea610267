#!/usr/bin/env bash
# Finds falsified cameras of simulated frames, and kitchen's; runs SLAM with what was found; rewrites calibration.md.
#   bash docs/results/calibration.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
out=runs/calibration
page=docs/results/calibration.md
mkdir -p "$out"
trap 'rm -f "$page.part"' EXIT

cat >"$out/kitchen.yaml" <<'YAML'
name: kitchen
seed: 7
nodes:
  - {name: camera, module: source.seven_scenes,
     params: {path: "${PPM_DATA}/kitchen", pixel_stride: 2, holdout: every 10th, held_out: followed}}
  - {name: init,   module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 1}}
  - {name: motion, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1},
     params: {sigma_t: 1 cm, sigma_r: 0.5 deg}}
  - {name: look,   module: prediction.raster, in: {frame: camera.frame}}
  - {name: align,  module: motion.aligned, in: {frame: camera.frame, view: look}, when: {from_frame: 1},
     params: {draw: optimum, stages: 1}}
  - {name: view,   module: prediction.raster, in: {frame: camera.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
  - {name: path,   module: sink.trajectory_tum}
  - {name: save,   module: sink.map_ppm, when: {at_end: true}}
YAML

find_camera() {  # NAME GRAPH ARGUMENTS...
  local name=$1 graph=$2; shift 2
  "$ppm" calibrate camera "$graph" --threads 1 "$@" >"$out/$name.txt"
}
settings() {  # FILE NODE: what a calibration printed, as --set arguments
  sed -n "s/^\([a-z_]*\): \([^#]*[^# ]\) *\(#.*\)\?$/--set\n$2.\1=\2/p" "$1"
}
slam() {  # NAME ARGUMENTS...
  local name=$1; shift
  "$ppm" run "$out/kitchen.yaml" --threads 1 --force --out "$out/$name" "$@" >"$out/$name.log" 2>&1
}
focal() { sed -n 's/^focal_scale: \([0-9.]*\) *# +- \(.*\)$/\1 ± \2/p' "$out/$1.txt"; }
bend() { sed -n 's/^depth_bend: \([-0-9.]*\) *# +- \(.*\)$/\1 ± \2/p' "$out/$1.txt"; }
row() {  # LABEL NAME
  jq -r --arg text "$1" 'def r(n): . * n | round / n; .holdout_estimated as $h |
    "| \($text) | \($h.coverage | r(10000)) | \($h.median_mm | r(100)) | \($h.mean_trunc20cm_mm | r(100)) | " +
    "\($h.within_1cm | r(1000)) / \($h.within_2cm | r(1000)) / \($h.within_5cm | r(1000)) | \($h.log_density | r(1000)) | " +
    "\($h.within_1_sigma | r(1000)) / \($h.within_2_sigma | r(1000)) | \(.trajectory.ate_rmse_m * 100 | r(100)) |"' "$out/$2/run.json"
}

for scale in 0.96 0.98 1.03; do
  find_camera "room_$scale" configs/room.yaml --set "camera.focal_scale=$scale"
done
find_camera room_bend configs/room.yaml --set camera.focal_scale=0.96 --set camera.depth_bend=0.02 --set camera.depth_bend_x=0.01
find_camera house configs/house_slam.yaml --set camera.focal_scale=0.97
find_camera icl configs/icl_mapping.yaml
find_camera focal_only "$out/kitchen.yaml" --depth-as-it-is
find_camera kitchen "$out/kitchen.yaml"
mapfile -t only < <(settings "$out/focal_only.txt" camera)
mapfile -t both < <(settings "$out/kitchen.txt" camera)
slam nominal
slam focal_only "${only[@]}"
slam calibrated "${both[@]}"
"$ppm" calibrate noise "$out/calibrated" --threads 1 >"$out/noise.txt"
mapfile -t noise < <(settings "$out/noise.txt" camera)
slam calibrated_noise "${both[@]}" "${noise[@]}"

{
  cat <<'TEXT'
# What calibration finds, and what it is worth

Written by `bash docs/results/calibration.sh`. How it works: [calibration](../calibration.md).

## Simulated frames whose camera was falsified

Truth is a focal scale of 1 and no bend. Focal length and distortion of depth are sought together, from 80 frames with the camera's noise.

| frames | falsified by | focal_scale found | depth_bend found |
|---|---|---|---|
TEXT
  for scale in 0.96 0.98 1.03; do echo "| \`room\` | focal_scale $scale | $(focal "room_$scale") | $(bend "room_$scale") |"; done
  echo "| \`room\` | focal_scale 0.96, depth_bend 0.02, depth_bend_x 0.01 | $(focal room_bend) | $(bend room_bend) |"
  echo "| \`house_slam\` | focal_scale 0.97 | $(focal house) | $(bend house) |"
  echo "| \`icl_mapping\` | nothing | $(focal icl) | $(bend icl) |"
  cat <<'TEXT'

## `kitchen`

The focal length alone (`--depth-as-it-is`):

TEXT
  sed 's/^/    /' "$out/focal_only.txt"
  echo
  echo "With the distortion of depth:"
  echo
  sed 's/^/    /' "$out/kitchen.txt"
  cat <<'TEXT'

SLAM with one hypothesis (`motion.aligned`, all 1,000 frames, one thread), held-out frames followed and never mapped, looked at from the estimated poses:

| camera | coverage | median, mm | truncated mean, mm | within 1 / 2 / 5 cm | log density | within 1 / 2 sigma | ATE, cm |
|---|---|---|---|---|---|---|---|
TEXT
  row "as stated" nominal
  row "focal length alone" focal_only
  row "focal length and distortion" calibrated
  row "and noise" calibrated_noise
  cat <<'TEXT'

ATE is against KinectFusion's poses, which were made of the distorted depths: it says nothing about which camera is right.

The stated focal length is not what is wrong: sought alone, it takes the place of a distortion of depth that is tilted and bowl-shaped over the image, a decimetre and
more in opposite corners at 3 m. Both halves of the sequence, which share no image, find that form; they differ by more than the stated uncertainty in how far depth bends in
the middle, which the first half can hardly tell from the focal length. What the numbers mean in the sensor is another matter: distortion of the lens, which is not in the
model, would be taken up by them too. What they are worth is what frames say that were neither fitted nor mapped: a quarter off the truncated mean.

`icl_kt3`, whose camera is exact, shows the limit. It turns little, and there the tilt of depth, 0.043 ± 0.013 / m, and the focal length are found wrong by about three standard deviations; its
second half alone, which turns, finds both right (1.0009 ± 0.0004, 0.0003 ± 0.0011).

## Noise, from the calibrated run

TEXT
  sed 's/^/    /' "$out/noise.txt"
} >"$page.part"
mv "$page.part" "$page"
echo "wrote $page"
