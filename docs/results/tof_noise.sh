#!/usr/bin/env bash
# Fits the noise of a time-of-flight camera to still images of an SR4000, and rewrites tof_noise.md and its picture.
#   bash docs/results/tof_noise.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
ppm=${PPM:-build/bin/ppm}
page=docs/results/tof_noise.md
picture=docs/images/tof_noise.png
bins=$(mktemp)
trap 'rm -f "$bins" "$page.part"' EXIT
command=(calibrate sensor configs/sr4000_still.yaml --set camera.last=-1)
fit=$("$ppm" "${command[@]}" --bins "$bins")

/usr/bin/python3 - "$bins" "$picture" <<'PYTHON'
import csv, sys
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(open(sys.argv[1]))]
light = [r["amplitude"] / r["range_m"] ** 2 for r in rows]
figure, axes = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
for axis, x, label in ((axes[0], light, "amplitude / range², 1/m²"), (axes[1], [r["range_m"] for r in rows], "range, m")):
    dots = axis.scatter(x, [1e3 * r["sigma_m"] for r in rows], s=[r["pixels"] / 40 for r in rows],
                        c=[r["range_m"] for r in rows] if axis is axes[0] else [r["amplitude"] for r in rows],
                        norm=None if axis is axes[0] else matplotlib.colors.LogNorm())
    figure.colorbar(dots, ax=axis, label="range, m" if axis is axes[0] else "amplitude")
    axis.set(xscale="log", yscale="log", xlabel=label, ylabel="standard deviation of a range, mm")
    axis.grid(which="both", alpha=0.3)
model = sorted(zip(light, (1e3 * r["model_m"] for r in rows)))
axes[0].plot(*zip(*model), "k", lw=1, label="model")
axes[0].legend()
figure.savefig(sys.argv[2], dpi=90)
PYTHON

{
  cat <<'TEXT'
# The noise of a time-of-flight camera

Written by `bash docs/results/tof_noise.sh`. Data: 4 places x 4 images of a SwissRanger SR4000 that stood still (`sr4000`). The fit:

TEXT
  echo "    ppm ${command[*]}"
  echo
  sed 's/^/    /' <<<"$fit"
  cat <<'TEXT'

![Repeatability against light and against range](../images/tof_noise.png)

Each dot is a bin of pixels of like range and like amplitude; its area is their number.

- **What is measured.** Repeatability: how far four images of one place differ, pixel by pixel, along the ray. Four values say little about one
  pixel, so pixels are pooled, and a bin's standard deviation comes from the *median* of their variances: pixels at edges, which jump between
  two surfaces, do not count.
- **The model.** A phase is measured, whose noise is the inverse of the light that comes back (Lange & Seitz 2001). The camera reports amplitudes made
  up for the distance; divided by the square of the range they fall on one line, whatever the range (left), while range alone says
  little (right). Exponents that are left free come out near the 2 and -1 of the theory, which needs no more parameters than two:
  the floor and the slope.
- **How good it is.** Shares of the standardised deviations within 1 and 2 standard deviations, over all pixels, edges included; each place is also judged by
  the fit to the other three, which has not seen it.
- **What it leaves out.** What repeats itself cannot be seen by repeating: the periodic error of the distance, light that takes two ways,
  scattering in the lens. They shift whole surfaces by millimetres to centimetres and stay the same from image to image. A map that fuses many images of
  one view will trust them too much; the map's excess variance (docs/map_update.md) is there for that.
TEXT
} >"$page.part"
mv "$page.part" "$page"
echo "wrote $page and $picture"
