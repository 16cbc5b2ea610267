"""Page (to stdout) and picture of the planned ways: house_plans.py HOUSE.ply RUNS PICTURE.png

RUNS holds a run's folder for each plan, mapped with known poses: its trajectory is the way itself."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.spatial.transform import Rotation

PLANS = ("loop", "tour", "corridor", "fast_turn", "kidnap")


def house_points(file):
    """Points on the house's surface, evenly spread, m. The file is binary: float x, y, z; uchar 3, int corners."""
    with open(file, "rb") as ply:
        data = ply.read()
    begin = data.index(b"end_header\n") + len(b"end_header\n")
    counts = {line.split()[1]: int(line.split()[2]) for line in data[:begin].splitlines() if line.startswith(b"element")}
    vertex = np.frombuffer(data, "<f4", counts[b"vertex"] * 3, begin).reshape(-1, 3).astype(float)
    corner = np.dtype([("n", "u1"), ("v", "<i4", 3)])
    face = vertex[np.frombuffer(data, corner, counts[b"face"], begin + counts[b"vertex"] * 12)["v"]]
    area = np.linalg.norm(np.cross(face[:, 1] - face[:, 0], face[:, 2] - face[:, 0]), axis=1) / 2
    random = np.random.default_rng(1)
    chosen = np.repeat(np.arange(len(face)), random.poisson(area * 1500))
    s, t = np.sqrt(random.random((len(chosen), 1))), random.random((len(chosen), 1))
    return face[chosen, 0] * (1 - s) + face[chosen, 1] * s * (1 - t) + face[chosen, 2] * s * t


def way(folder, plan):
    """Positions [n, 3] and rotations of the camera."""
    rows = np.loadtxt(f"{folder}/{plan}/trajectory.tum")
    return rows[:, 0], rows[:, 1:4], Rotation.from_quat(rows[:, 4:])


def draw(points, ways, file):
    seen = points[(points[:, 2] > 0.1) & (points[:, 2] < 2)]
    figure, axes = plt.subplots(2, 1, figsize=(10, 12.4), sharex=True, layout="constrained")
    for panel, plans in zip(axes, (("loop", "tour"), ("corridor", "fast_turn", "kidnap"))):
        panel.scatter(seen[:, 0], seen[:, 1], s=0.05, c="0.55", rasterized=True)
        for plan, color in zip(plans, ("tab:orange", "tab:blue", "tab:green")):
            _, p, R = ways[plan]
            jumps = np.linalg.norm(np.diff(p, axis=0), axis=1) > 1
            line = np.insert(p, np.flatnonzero(jumps) + 1, np.nan, axis=0)
            wide = {"lw": 5, "alpha": 0.4} if plan == "loop" else {"lw": 1.5}  # the tour begins and ends as the loop does
            panel.plot(line[:, 0], line[:, 1], color=color, label=plan, **wide)
            look = R.apply([0, 0, 1])
            every = slice(0, None, 12)
            panel.quiver(p[every, 0], p[every, 1], look[every, 0], look[every, 1], color=color, scale=28, width=0.0022)
            panel.plot(*p[0, :2], "o", color=color, ms=6)
        panel.set_aspect("equal")
        panel.legend(loc="upper right")
        panel.set_ylabel("y, m")
    axes[-1].set_xlabel("x, m")
    figure.savefig(file, dpi=80)


def row(folder, plan, one):
    stamp, p, R = one
    step = np.linalg.norm(np.diff(p, axis=0), axis=1)
    moved = np.append(step < 1, True)[:-1]  # a jump is no way
    between = np.diff(stamp) < 0.11  # neighbours: held-out images are not on the path
    turn = np.degrees((R[:-1].inv() * R[1:]).magnitude())
    with open(f"{folder}/{plan}/run.json") as file:
        held = json.load(file)["holdout"]
    return (f"| `{plan}` | {step[moved].sum():.1f} | {stamp[-1]:.1f} | {100 * step[moved & between].max():.0f} | "
            f"{turn[moved & between].max():.0f} | {held['coverage']:.3f} | {held['median_mm']:.1f} |")


points = house_points(sys.argv[1])
ways = {plan: way(sys.argv[2], plan) for plan in PLANS}
draw(points, ways, sys.argv[3])
print("<!-- Written by docs/results/house_plans.sh; do not edit. -->\n")
print("# The planned ways through the simulated house\n")
print("Each was mapped with known poses ([configs/house_mapping.yaml](../../configs/house_mapping.yaml), `tof176`, 10 Hz); every tenth")
print("image was held out. [What the ways are for](../simulation.md).\n")
print("| plan | m | s | largest step, cm | largest turn, degrees | held-out coverage | median error, mm |")
print("|---|---|---|---|---|---|---|")
for plan in PLANS:
    print(row(sys.argv[2], plan, ways[plan]))
print("\nSteps and turns are between neighbouring images; the jump of `kidnap` is none.\n")
print("![The ways, from above](../images/house_plans.png)\n")
print("![The map of the tour](../images/house_tour.png)")
