"""Tables (to stdout) and the plot of what true_pose_weight measured: weights.py MEASURED.csv PICTURE.png"""
import csv
import statistics
import sys
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

rows = defaultdict(list)
with open(sys.argv[1]) as file:
    for row in csv.DictReader(file):
        rows[row["study"], row["module"], row["params"]].append(row)

TITLES = {"form": "Forms", "outliers": "Share of outliers, and pixels", "temper": "Temper",
          "misses": "Density of misses", "model": "Deviation of the model", "jumps": "Pixels at depth jumps"}


def quantile(values, q):
    return sorted(values)[min(len(values) - 1, int(q * len(values)))]


def summary(some):
    get = lambda key: [float(r[key]) for r in some]
    return dict(nearest=statistics.median(get("rank_nearest")), truth=statistics.median(get("rank_truth")),
                truth90=quantile(get("rank_truth"), 0.9), kept=statistics.mean(get("kept")),
                error=statistics.mean(get("error")), ess=statistics.median(get("ess")))


results = {key: summary(some) for key, some in rows.items()}
frames = len(next(iter(rows.values())))
print(f"\n{frames} frames.")
for study, title in TITLES.items():
    print(f"\n### {title}\n")
    print("| weighting | rank of the nearest, median | rank of the true pose, median / 90 % | true pose kept | weighted error, sigma | ESS, median |")
    print("|---|---|---|---|---|---|")
    for (of, module, params), r in results.items():
        if of == study:
            print(f"| `{module}` `{params}` | {r['nearest']:.0f} | {r['truth']:.0f} / {r['truth90']:.0f} | {r['kept']:.3f} | "
                  f"{r['error']:.2f} | {r['ess']:.1f} |")

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 3.8))
forms = [(module, params) for of, module, params in results if of == "form"]
labels = [f"{m.split('.')[1]} {p}".replace("temper_least: 1e-6", "").replace(", }", "}").replace("texel_and_sensor", "both") for m, p in forms]
values = [results["form", m, p] for m, p in forms]
left.barh(labels, [v["kept"] for v in values], color="#175c9e")
left.invert_yaxis()
left.set_xlabel("chance that resampling keeps the true pose")
left.set_xlim(0, 1)
left.tick_params(axis="y", labelsize=7)
temper = [(float(p.split(":")[1].rstrip("}")), r) for (of, m, p), r in results.items() if of == "temper"]
right.semilogx([t for t, _ in temper], [r["kept"] for _, r in temper], "o-", color="#175c9e", label="true pose kept")
right.semilogx([t for t, _ in temper], [r["error"] / max(r["error"] for _, r in temper) for _, r in temper], "s--", color="#b5542b",
               label="weighted error / largest")
right.set_xlabel("temper of weighting.robust, 1,200 pixels")
right.set_ylim(0, 1.05)
right.legend(frameon=False, fontsize=8)
for axes in (left, right):
    axes.spines[["top", "right"]].set_visible(False)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
