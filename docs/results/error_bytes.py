"""Table (to stdout) and plot of error against bytes: error_bytes.py PPM.jsonl GRIDS.jsonl PLOT.png"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def lines(path):
    with open(path) as file:
        return [json.loads(line) for line in file]


ppm, grids = lines(sys.argv[1]), lines(sys.argv[2])
series = {"PPM": ppm}
for row in grids:
    series.setdefault(row["map"], []).append(row)

print("# Error against bytes\n")
print("Written by `bash docs/results/error_bytes.sh`: the kitchen with its reference poses, 500 images mapped, 100 held out")
print("([metrics](../metrics.md)). PPM: the level of detail is set by the parameters named. OctoMap 1.9.7 with its defaults and Open3D 0.16's")
print("scalable TSDF, truncation at four voxels: [what they are taken to say](../maps_grids.md), with the same frames, pixels and scores.\n")
print("![Median and truncated mean error against memory](../images/error_bytes.png)\n")
print("| map | MiB | coverage | median, mm | within 1 / 2 / 5 cm | truncated mean, mm |")
print("|---|---|---|---|---|---|")
for name, rows in series.items():
    for r in rows:
        label = f"PPM, `{r['name']}`" if name == "PPM" else f"{name}, {100 * r['resolution_m']:g} cm"
        print(f"| {label} | {r['bytes'] / 2**20:.2f} | {r['coverage']:.4f} | {r['median_mm']:.2f} | "
              f"{r['within_1cm']:.3f} / {r['within_2cm']:.3f} / {r['within_5cm']:.3f} | {r['mean_trunc20cm_mm']:.1f} |")

figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
for axis, field, label in ((axes[0], "median_mm", "median error, mm"),
                           (axes[1], "mean_trunc20cm_mm", "mean error truncated at 20 cm, mm")):
    for name, rows in series.items():
        rows = sorted(rows, key=lambda r: r["bytes"])
        axis.plot([r["bytes"] / 2**20 for r in rows], [r[field] for r in rows], "o-", label=name)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("memory, MiB")
    axis.set_ylabel(label)
    axis.grid(True, which="both", alpha=0.3)
axes[0].legend()
figure.savefig(sys.argv[3], dpi=110)
