"""Tables of map_update_speed.md from what map_update_speed.sh ran: python3 map_update_speed.py FOLDER (of runs)."""
import json
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
READ_GB_S = 15  # of this kind of machine, a thread


def times():
    cases = {}
    for run in json.loads((folder / "bench.json").read_text())["benchmarks"]:
        if run.get("aggregate_name", "median") == "median":
            cases[run["run_name"]] = run
    return cases


def us(run):
    return f"{run['cpu_time']:.0f}"


def gather(cases):
    print("| triangles | texels in view | one by one, ns a texel | by vectors | ratio |")
    print("|---|---|---|---|---|")
    for triangles in (20000, 100000):
        one, vectors = (cases[f"gather/{how}/{triangles}/40/100"] for how in ("one_by_one", "vectors"))
        n = one["texels"]
        print(f"| {triangles // 1000}k | {n / 1000:.1f}k | {1e3 * one['cpu_time'] / n:.1f} | {1e3 * vectors['cpu_time'] / n:.1f} | "
              f"{one['cpu_time'] / vectors['cpu_time']:.1f} |")


def frames(cases):
    print("| triangles | texel, cm | cell, m | faces / texels in view | texels of their chunks, kB | faces found, us | texels in place, us "
          "| texels of a copy, us | moved, MB; at the roof, us | keyframe, us |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name, found in cases.items():
        if not name.startswith("visible_faces/"):
            continue
        sizes = name.split("/")[1:]
        triangles, texel, cell = (int(s.split(":")[1]) for s in sizes)
        place, copy, keyframe = (cases["/".join([kind] + sizes)] for kind in ("texels_in_place", "texels_of_a_copy", "keyframe"))
        # Read and written: what is cloned, and mean and variance of each texel in view.
        moved = 2 * found["kB"] * 1e3 + 2 * 8 * found["texels"]
        print(f"| {triangles // 1000}k | {texel / 10:g} | {cell / 100:g} | {found['faces']:.0f} / {found['texels'] / 1000:.1f}k | {found['kB']:.0f} | "
              f"{us(found)} | {us(place)} | {us(copy)} | {moved / 1e6:.2f}; {moved / READ_GB_S / 1e3:.0f} | {us(keyframe)} |")


def load(name):
    return json.loads((folder / name / "run.json").read_text())


def mapping(names):
    print("| `keyframe_every` | `between` | coverage | median mm | within 1 / 2 / 5 cm | mean trunc. mm | log density | faces | MiB |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in names:
        _, every, between = name.split("_")
        run = load(name)
        h, m = run["holdout"], run["map"]
        print(f"| {every} | {between} | {h['coverage']:.4f} | {h['median_mm']:.2f} | {h['within_1cm']:.3f} / {h['within_2cm']:.3f} / {h['within_5cm']:.3f} | "
              f"{h['mean_trunc20cm_mm']:.1f} | {h['log_density']:.2f} | {m['faces']} | {m['bytes'] / 2**20:.2f} |")


def slam(cases, first):
    print(f"| {first} | ATE, cm, seeds 7 / 8 / 9 | mean | coverage | median mm | maps, MiB owned | share of what they were alone | update, ms a frame |")
    print("|---|---|---|---|---|---|---|---|")
    for label, names in cases:
        runs = [load(n) for n in names]
        mean = lambda get: sum(map(get, runs)) / len(runs)
        owned = mean(lambda r: r["map"]["bytes_owned_total"])
        alone = owned + mean(lambda r: r["map"]["bytes_shared_total"])
        ate = [100 * r["trajectory"]["ate_rmse_m"] for r in runs]
        print(f"| {label} | {' / '.join(f'{a:.1f}' for a in ate)} | {sum(ate) / len(ate):.1f} | {mean(lambda r: r['holdout']['coverage']):.3f} | "
              f"{mean(lambda r: r['holdout']['median_mm']):.1f} | {owned / 2**20:.1f} | {100 * owned / alone:.1f} % | "
              f"{mean(lambda r: r['nodes']['update']['ms_mean']):.0f} |")


def cells():
    print("| `cell_size` | chunks | maps, MiB owned | share of what they were alone | update, ms a frame | view, ms a frame |")
    print("|---|---|---|---|---|---|")
    for cell in ("25cm", "50cm", "1m", "2m"):
        run = load(f"cell_{cell}")
        m = run["map"]
        owned = m["bytes_owned_total"]
        print(f"| {cell} | {m['chunks']} | {owned / 2**20:.1f} | {100 * owned / (owned + m['bytes_shared_total']):.1f} % | "
              f"{run['nodes']['update']['ms_mean']:.0f} | {run['nodes']['view']['ms_mean']:.0f} |")


cases = times()
print("# The map update's speed, and what keyframes save\n")
print("Written by `bash docs/results/map_update_speed.sh`. Times are of CPU, one thread, on a machine of the kind in [views](views.md).\n")
print("## Texels read the image by vectors\n")
print("`gather_faces` against the test's reference, which reads one texel after the other, in one run of `bench_update`:\n")
gather(cases)
print("\n## A frame of one particle\n")
print("A meshed room seen by 176x144 pixels that the map explains; 40 maps with texels of their own, more than caches hold. *Texels*: a frame between")
print("keyframes, from the faces that a view shows to the map; *of a copy*: another particle shares all chunks, so that those in view are cloned first;")
print(f"*moved*: bytes read and written then, and their time at {READ_GB_S} GB/s.\n")
frames(cases)
print("\n## Keyframes\n")
print("`kitchen_mapping.yaml`, known poses, one thread:\n")
mapping([f"map_{e}_{b}" for e, b in ((1, "texels"), (2, "texels"), (2, "nothing"), (4, "texels"), (4, "nothing"), (8, "texels"), (8, "nothing"))])
print("\n`kitchen_slam_motion.yaml`, 270 frames, 100 particles, three seeds (ms: wall time; only large ratios mean something on a machine that does other work too):\n")
slam([(f"`keyframe_every: {e}`, `between: {b}`", [f"slam_{e}_{b}_{s}" for s in (7, 8, 9)]) for e, b in ((1, "texels"), (4, "texels"), (4, "nothing"))], "policy")
print("\n## Size of chunks\n")
print("`kitchen_slam_motion.yaml`, seed 7, 270 frames, the whole update in every frame:\n")
cells()
