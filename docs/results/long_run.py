"""Page (to stdout) and plot of a run's time and memory by frame: long_run.py RUN_FOLDER SPARSE_RUN_FOLDER PLOT.png"""
import csv
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def columns(path, *names):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return [np.array([float(r[n]) if r[n] else np.nan for r in rows]) for n in names]


def load(folder):
    """run.json; and of the frames whose maps were counted: number, MB of all maps, of one, and a particle's share beyond the first."""
    with open(folder + "/run.json") as file:
        run = json.load(file)
    at, owned, alone = columns(folder + "/metrics.csv", "frame", "table.map_bytes_owned", "table.map_bytes_alone")
    known = ~np.isnan(owned)
    at, owned, one = at[known], owned[known] / 1e6, alone[known] / 1e6 / run["particles"]
    return run, at, owned, one, (owned - one) / (run["particles"] - 1) / one


folder = sys.argv[1]
run, at, owned, one, share = load(folder)
sparse, _, _, _, sparse_share = load(sys.argv[2])
frame, ms, wall, resident, heap = columns(folder + "/times.csv", "frame", "cpu_ms", "wall_ms", "resident_mb", "heap_mb")

block = 25  # frames: medians over so many
starts = np.arange(block, len(frame) - block + 1, block)
middle = starts + block / 2
block_ms = np.array([np.median(ms[s:s + block]) for s in starts])
block_one = np.interp(middle, at, one)
# What is no map, at the frames whose maps were counted.
rest = np.interp(at, frame, heap) - owned
block_rest = np.array([np.median(rest[(at >= s) & (at < s + block)]) for s in starts])


def slope(values, *others):
    """Per 1,000 frames, what remains when the other columns are taken out by least squares; and its standard error."""
    A = np.column_stack([np.ones_like(middle), middle / 1000, *others])
    x, _, _, _ = np.linalg.lstsq(A, values, rcond=None)
    variance = np.sum((A @ x - values) ** 2) / max(len(values) - A.shape[1], 1)
    return x[1], np.sqrt(variance * np.linalg.inv(A.T @ A)[1, 1])


ms_slope, ms_error = slope(block_ms)
ms_rest, ms_rest_error = slope(block_ms, block_one)
rest_slope, rest_error = slope(block_rest)

print("# Time and memory over a long run\n")
print("Written by `bash docs/results/long_run.sh`: SLAM on all images of `kitchen`, "
      f"{run['frames']} frames, {run['particles']} particles, {run['threads']} threads; "
      "`configs/kitchen_slam_motion.yaml` with `prediction.raster`, no image held out, without the sinks that draw. Times of frames are those of "
      "all threads on their processors, memory in use is what was allocated and not given back (`ppm run --times`); maps are counted by "
      "`sink.metrics`.\n")
print("![Time and memory by frame](../images/long_run.png)\n")
print("| | |")
print("|---|---|")
print(f"| frames/s over the run | {run['fps']:.1f} |")
print(f"| time of a frame, median of the first and last 100, ms | {np.median(ms[1:101]):.1f}, {np.median(ms[-100:]):.1f} |")
print(f"| the same on the clock, ms | {np.median(wall[1:101]):.1f}, {np.median(wall[-100:]):.1f} |")
print(f"| growth of a frame's time, ms in 1,000 frames | {ms_slope:+.1f} ± {ms_error:.1f} |")
print(f"| the same with the growth of the map taken out (least squares on frame number and bytes of one map) | {ms_rest:+.1f} ± {ms_rest_error:.1f} |")
print(f"| one map at the end, MB | {one[-1]:.2f} |")
print(f"| all maps together at the end; mean, MB | {owned[-1]:.1f}; {np.mean(owned):.1f} |")
print(f"| a particle beyond the first: share of a map, median over the run; at the end; most (wanted: 5 %) | "
      f"{100 * np.median(share):.1f} %; {100 * share[-1]:.1f} %; {100 * np.max(share):.1f} % |")
print(f"| memory of the process at the end, resident; in use, MB | {resident[-1]:.0f}; {heap[-1]:.0f} |")
print(f"| growth of what is in use and is no map, MB in 1,000 frames | {rest_slope:+.1f} ± {rest_error:.1f} |")
print("\nThe same with a map update in each fourth frame alone (`--set update.keyframe_every=4 --set update.between=nothing`):\n")
print("| | every frame | every fourth |")
print("|---|---|---|")
print(f"| frames/s | {run['fps']:.1f} | {sparse['fps']:.1f} |")
print(f"| ATE, cm | {100 * run['trajectory']['ate_rmse_m']:.2f} | {100 * sparse['trajectory']['ate_rmse_m']:.2f} |")
print("| a particle beyond the first: share of a map, median; at the end; most | " + " | ".join(
    f"{100 * np.median(s):.1f} %; {100 * s[-1]:.1f} %; {100 * np.max(s):.1f} %" for s in (share, sparse_share)) + " |")
print("\nErrors are standard errors of the fit to medians over 25 frames. A particle's share counts all that it does not have in "
      "common with another: after resampling most particles descend from few, and what their ancestors mapped is theirs together. What is in use and is no map is memory kept for "
      "reuse, most of it by the views of `prediction.raster`, each of which keeps the memory of the largest view that it was used for: with "
      "`prediction.embree` the same graph had 69 MB in use at the end, 25 of them maps and 16 acceleration structures.")

figure, axes = plt.subplots(1, 3, figsize=(12, 3.4), constrained_layout=True)
axes[0].plot(frame[1:], ms[1:], ".", markersize=2, color="0.7", label="frame")
axes[0].plot(middle, block_ms, label="median of 25")
axes[0].set_ylim(0, 1.1 * np.quantile(ms[1:], 0.995))
axes[0].set_ylabel("processor time of a frame, ms")
axes[1].plot(frame, resident, label="process, resident", color="0.6")
axes[1].plot(frame, heap, label="process, in use")
axes[1].plot(at, owned, label=f"maps of {run['particles']} particles")
axes[1].plot(at, one, label="one map")
axes[1].set_ylabel("memory, MB")
axes[1].set_ylim(0, 1.45 * np.max(resident))
axes[2].plot(at, 100 * share)
axes[2].axhline(5, color="0.5", linestyle="--")
axes[2].set_ylabel("a particle beyond the first, % of a map")
axes[2].set_ylim(0, None)
for axis in axes:
    axis.set_xlabel("frame")
    axis.grid(alpha=0.3)
for axis in axes[:2]:
    axis.legend(loc="upper left", fontsize=8)
figure.savefig(sys.argv[3], dpi=90)
