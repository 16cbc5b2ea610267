"""Page (to stdout) and plots of what `ppm bench` measured: views.py BENCH.json FINE.json AGREEMENT.md PLOT_FOLDER

FINE: weights and frames of the rasterizer on maps with finer texels."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

with open(sys.argv[1]) as file:
    bench = json.load(file)
with open(sys.argv[2]) as file:
    fine = json.load(file)
with open(sys.argv[3]) as file:
    agreement = file.read()
folder = sys.argv[4]
cases = [c for c in bench["cases"] if "ms_best" in c]
left_out = {c["settings"]["backend"]: c["left_out"] for c in bench["cases"] if "left_out" in c and "backend" in c["settings"]}
backends = sorted({c["settings"]["backend"] for c in cases if "backend" in c["settings"]})
SIZES = ("20000", "100000", "500000")
LABEL = {"20000": "20k", "100000": "100k", "500000": "500k"}


def find(group, among=cases, **settings):
    """The one case with exactly these settings, or None."""
    wanted = {k: str(v) for k, v in settings.items()}
    return next((c for c in among if c["group"] == group and c["settings"] == wanted), None)


def find_fine(group, **settings):
    return find(group, among=fine["cases"], **settings)


def ms(case, digits=3):
    return f"{case['ms_best']:.{digits}g}" if case else "-"


def short(module):
    return module.split(".")[-1]


def roof(of, threads):
    case = find("roof", of=of, threads=threads)
    return 1e3 / case["ms_best"] if case else None


threads = bench["threads"]
print("# Views, weights and frames: what they cost\n")
print(f"Written by `bash docs/results/views.sh` from one run of `ppm bench`: {bench['processor']}, {threads} threads, the least of "
      f"{bench['rounds']} rounds over all cases. Scene: a closed room of 6 x 5 x 2.7 m with ten boxes, uniformly meshed, texels every {100 * bench['texel_size_m']:.0f} cm, cells "
      "as in `map.ppm_empty`; a camera of 176 x 144 pixels. All times are of the graph's own nodes in the executor. Views are jittered by 2 cm and "
      "1 degree; in whole frames, whose map update would take the edges of things for new surface from such poses, by 3 mm and "
      "0.2 degrees as in the graphs that ship.\n")
for name, reason in left_out.items():
    print(f"`{name}` was left out: {reason}\n")


def targets():
    print("## What was to be reached\n")
    print("| | prototype | to reach | measured |")
    print("|---|---|---|---|")
    raster, embree = (find("view", backend="prediction." + b, triangles=100000) for b in ("raster", "embree"))
    if raster and embree:
        rays = embree["counters"]["rays"] / embree["ms_best"] / 1e3
        ratio = embree["ms_best"] / raster["ms_best"]
        verdict = "" if ratio >= 4 and rays >= 16 else "**missed**: "
        print(f"| raster against Embree packets, ms a view, 100k triangles | 0.37 against 1.54 | >= 4 times faster, Embree at >= 16 Mray/s | "
              f"{verdict}{ms(raster)} against {ms(embree)}: {ratio:.1f} times; Embree {rays:.1f} Mray/s |")

    def row(text, prototype, goals, found):
        if None in found:
            return
        missed = any(f["ms_best"] > goal for f, goal in zip(found, goals))
        print(f"| {text} | {prototype} | <= {goals[0]:.2f} / {goals[1]:.2f} ms | {'**missed**: ' if missed else ''}"
              f"{ms(found[0])} / {ms(found[1])} ms |")

    for weighting in ("gaussian", "robust"):
        row(f"weigh one particle, full image, 20k / 100k triangles, one thread, `weighting.{weighting}`", "0.21 / 0.51 ms", (0.20, 0.45),
            [find("weigh", backend="prediction.raster", weighting="weighting." + weighting, triangles=n) for n in (20000, 100000)])
    row("the same with texels every 2 cm, `weighting.gaussian`", "0.21 / 0.51 ms", (0.20, 0.45),
        [find_fine("weigh", backend="prediction.raster", weighting="weighting.gaussian", triangles=n) for n in (20000, 100000)])
    for maps, text in (("own", "written in place"), ("cloned", "all chunks in view cloned, in every frame")):
        for size, found in ((bench, find), (fine, find_fine)):
            row(f"whole frame a particle, 20k / 100k, {threads} threads, own maps; texels (every {100 * size['texel_size_m']:.0f} cm) alone, {text}",
                "0.25 / 0.65 ms", (0.20, 0.50),
                [found("frame", backend="prediction.raster", maps=maps, update="texels", triangles=n, particles=32, threads=threads)
                 for n in (20000, 100000)])
    for maps, update, text in (("cloned", "keyframes_and_texels", "texels in every frame, new surface in each sixth; chunks cloned"),
                               ("own", "keyframes_and_texels", "the same, written in place"),
                               ("cloned", "full", "the whole update in every frame, chunks cloned")):
        row(f"whole frame a particle, 20k / 100k, {threads} threads, own maps; {text}", "0.25 / 0.65 ms", (0.20, 0.50),
            [find("frame", backend="prediction.raster", maps=maps, update=update, triangles=n, particles=32, threads=threads)
             for n in (20000, 100000)])
    for pixels, text in ((0, "all pixels weighed"), (1200, "1,200 pixels weighed, as the graphs that ship do")):
        shared, own = (find("frame", backend="prediction." + b, maps="shared", update="keyframes", triangles=20000, particles=1000,
                            threads=threads, pixels=pixels) for b in ("shared_view", "raster"))
        if shared and own:
            verdict = "" if shared["ms_best"] <= 0.1 else "**missed**: "
            print(f"| particles at 10 Hz with `shared_view` and updates in keyframes, 20k, {text} | - | >= 1,000 | "
                  f"{verdict}{100 / shared['ms_best']:.0f} (`raster`: {100 / own['ms_best']:.0f}) |")
    print("| memory a particle after 1,000 frames of `kitchen`, 100 particles | - | <= 5 % of the map beyond the first | "
          "[the long run](long_run.md) |")
    print()


def view_tables():
    print("## A view\n")
    print("![Views by triangles](../images/views_triangles.png)\n")
    print("ms a view, one thread; `arrays` are all arrays of the Prediction, where the first figure is what a likelihood starts from.\n")
    print("| back-end | " + " | ".join(f"{LABEL[n]} | {LABEL[n]}, arrays" for n in SIZES) + " |")
    print("|---|" + "---|" * (2 * len(SIZES)))
    for b in backends:
        cells = [f"{ms(find('view', backend=b, triangles=n))} | {ms(find('view_filled', backend=b, triangles=n))}" for n in SIZES]
        print(f"| `{b}` | " + " | ".join(cells) + " |")
    print()
    colours = {b: f"C{i}" for i, b in enumerate(backends)}
    figure, axis = plt.subplots(figsize=(5, 3.6), constrained_layout=True)
    for b in backends:
        for group, style in (("view", "o-"), ("view_filled", "o:")):
            points = [(int(n), find(group, backend=b, triangles=n)) for n in SIZES]
            points = [(n, c["ms_best"]) for n, c in points if c]
            axis.plot(*zip(*points), style, color=colours[b], label=short(b) if group == "view" else None)
    axis.plot([], [], ":", color="0.5", label="with all arrays")
    axis.set(xscale="log", yscale="log", xlabel="triangles", ylabel="ms a view of 176 x 144")
    axis.grid(True, which="both", alpha=0.3)
    axis.set_ylim(None, 4 * axis.get_ylim()[1])
    axis.legend(loc="upper left", fontsize=8, ncols=2)
    figure.savefig(folder + "/views_triangles.png", dpi=90)


def sparse_tables():
    print("### Sparse views\n")
    print("Mray/s by rays a view (`stride`), one thread; a bold figure is the fastest.\n")
    strides = (16, 8, 4, 2, None)
    for n in SIZES:
        rows = {}
        for b in backends:
            if b == "prediction.shared_view":
                continue
            found = [find("view", backend=b, triangles=n, **({"stride": s} if s else {})) for s in strides]
            if all(found):
                rows[b] = [(c["counters"]["rays"], c["counters"]["rays"] / c["ms_best"] / 1e3) for c in found]
        if len(rows) < 2:
            continue
        best = [max(r[i][1] for r in rows.values()) for i in range(len(strides))]
        print(f"| {LABEL[n]} triangles | " + " | ".join(f"{int(r[0])} rays" for r in next(iter(rows.values()))) + " |")
        print("|---|" + "---|" * len(strides))
        for b, row in rows.items():
            cells = [f"**{r:.2f}**" if r == best[i] else f"{r:.2f}" for i, (_, r) in enumerate(row)]
            print(f"| `{b}` | " + " | ".join(cells) + " |")
        print()
        print(crossing(rows))
    plot_sparse(strides)


def crossing(rows):
    """Where Embree and the rasterizer are equally fast, by interpolation of the times."""
    embree, raster = rows.get("prediction.embree"), rows.get("prediction.raster")
    if not embree or not raster:
        return ""
    times = [(n, n / e, n / r) for (n, e), (_, r) in zip(embree, raster)]
    if times[0][1] > times[0][2]:
        return f"The rasterizer is faster from {int(times[0][0])} rays on, the fewest that were measured.\n"
    for (n0, e0, r0), (n1, e1, r1) in zip(times, times[1:]):
        if e1 > r1:
            return f"Below about {n0 + (n1 - n0) * (r0 - e0) / ((e1 - e0) - (r1 - r0)):.0f} rays a view Embree is faster.\n"
    return "Embree is faster throughout.\n"


def plot_sparse(strides):
    print("![Rays a second for sparse views](../images/views_sparse.png)\n")
    figure, axes = plt.subplots(1, len(SIZES), figsize=(11, 3.4), constrained_layout=True, sharey=True)
    for axis, n in zip(axes, SIZES):
        for i, b in enumerate(backends):
            found = [find("view", backend=b, triangles=n, **({"stride": s} if s else {})) for s in strides]
            found = [c for c in found if c]
            if found and b != "prediction.shared_view":
                axis.plot([c["counters"]["rays"] for c in found], [c["counters"]["rays"] / c["ms_best"] / 1e3 for c in found], "o-",
                          color=f"C{i}", label=short(b))
        axis.set(xscale="log", yscale="log", xlabel="rays a view", title=f"{LABEL[n]} triangles")
        axis.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel("Mray/s")
    axes[0].legend()
    figure.savefig(folder + "/views_sparse.png", dpi=90)


def filter_tables():
    print("## Weights\n")
    print("View and likelihood of all pixels, ms a particle, one map, one thread.\n")
    print("| | " + " | ".join(f"{LABEL[n]}, gaussian | {LABEL[n]}, robust" for n in SIZES) + " |")
    print("|---|" + "---|" * (2 * len(SIZES)))
    for b in backends:
        cells = [ms(find("weigh", backend=b, weighting=w, triangles=n)) for n in SIZES for w in ("weighting.gaussian", "weighting.robust")]
        print(f"| `{b}` | " + " | ".join(cells) + " |")
    print("\n## Whole frames\n")
    print("View, likelihood of all pixels, resampling and map update: ms a particle and frame. Every particle's map is its own, shape and "
          "texels; `cloned`: the maps of the frame before are kept, so that every chunk that is written is cloned first; `own`: nothing is; "
          "`shared`: all particles start with one map, and are resampled by `weighting.robust` as it is by default but for the number of pixels. The update is `full` in every "
          "frame; `texels`: of what is seen alone, as where the map explains the view; `keyframes and texels`: in each sixth, in between the texels of what is seen (`keyframe_every: 6`); `keyframes`: view and update "
          "in each sixth frame alone (`when: {every: 6}`), by `prediction.raster`.\n")
    rows = [c for c in cases if c["group"] == "frame"]
    print("| back-end | maps | update | triangles | particles | threads | pixels | ms |")
    print("|---|---|---|---|---|---|---|---|")
    for c in rows:
        s = c["settings"]
        print(f"| `{s['backend']}` | {s['maps']} | {s['update'].replace('_', ' ')} | {LABEL.get(s['triangles'], s['triangles'])} | {s['particles']} | {s['threads']} | "
              f"{s.get('pixels', '0').replace('1200', '1,200') if s.get('pixels', '0') != '0' else 'all'} | {ms(c)} |")
    print("\nThe map update alone, one thread:\n")
    print("| maps | update | triangles | ms a particle and frame |")
    print("|---|---|---|---|")
    for c in (c for c in cases if c["group"] == "update"):
        s = c["settings"]
        print(f"| {s['maps']} | {s['update'].replace('_', ' ')} | {LABEL[s['triangles']]} | {ms(c)} |")
    print("\n![Whole frames by particles and threads](../images/views_frames.png)\n")
    plot_frames(rows)
    print("Others: " + "; ".join(f"`{c['name']}` {1e3 * c['ms_best']:.3g} us a {c['item']}" for c in cases if c["group"] in ("gather", "simplify"))
          + ".\n")


def plot_frames(rows):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), constrained_layout=True)
    raster = [c for c in rows if c["settings"]["backend"] == "prediction.raster" and c["settings"]["maps"] == "cloned"
              and c["settings"]["update"] == "keyframes_and_texels"]
    by_particles = sorted((int(c["settings"]["particles"]), c["ms_best"]) for c in raster
                          if c["settings"]["triangles"] == "20000" and c["settings"]["threads"] == str(threads))
    axes[0].plot(*zip(*by_particles), "o-", label=f"20k triangles, {threads} threads")
    axes[0].set(xscale="log", xlabel="particles", ylabel="ms a particle and frame")
    axes[0].set_ylim(0, None)
    for n in SIZES:
        points = sorted((int(c["settings"]["threads"]), c["ms_best"]) for c in raster
                        if c["settings"]["triangles"] == n and c["settings"]["particles"] in ("32", "8" if n == "500000" else "32"))
        if points:
            axes[1].plot(*zip(*points), "o-", label=f"{LABEL[n]} triangles")
    axes[1].set(xlabel="threads", ylabel="ms a particle and frame", xticks=range(1, threads + 1))
    axes[1].set_ylim(0, None)
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.legend()
    figure.savefig(folder + "/views_frames.png", dpi=90)


def roofs():
    print("## The machine's roofs\n")
    print("| threads | GFLOP/s | GB/s read |")
    print("|---|---|---|")
    for n in sorted({int(c["settings"]["threads"]) for c in cases if c["group"] == "roof"}):
        print(f"| {n} | {roof('flops', n):.0f} | {roof('read', n):.1f} |")
    print("\nIndependent fused multiply-adds on the widest registers; the sum of 512 MB.\n")
    print("What the three hottest kernels take at least on 100k triangles, one thread, by count, and the share of the roofs that this is "
          "(above 100 % of GB/s: it comes from caches):\n")
    print("| kernel | ms | Mflop | share of GFLOP/s | MB | share of GB/s | counted |")
    print("|---|---|---|---|---|---|---|")
    for k in bench["kernels"]:
        print(f"| {k['kernel']} | {k['ms']:.3g} | {k['flops'] / 1e6:.2f} | {100 * k['flops_share']:.1f} % | {k['bytes'] / 1e6:.2f} | "
              f"{100 * k['read_share']:.0f} % | {k['basis']} |")
    print("\nWhat limits them, as far as the counts and the code tell: the view spends its instructions on what is no flop (corners gathered, "
          "boxes, compares, masks, one pixel stored at a time); attributes wait for gathers, a pixel's face and six texel values from "
          "several cache lines; the update for the memory of chunks that are cloned and of texels that no cache holds any more.\n")


targets()
view_tables()
sparse_tables()
filter_tables()
roofs()
print("## Whether they agree\n")
print("Every back-end that answers exactly is asked for the same views, and an oracle in double precision that tries the faces of the map decides "
      "pixel by pixel (`tests/prediction/agreement.hpp`): `same` element; a `tie`, another element at the same range; an `edge`: what a ray "
      "within 1/64 pixel meets; a `sliver`: the same, shown by outlines because no such ray was found; `close`: right without what is nearer "
      "than 1 cm; a fault otherwise. Ranges, points, normals and texels have tolerances near single precision; the last column is the "
      "largest error in units of those. Faults, and errors above 1, fail the tests.\n")
print(agreement)
