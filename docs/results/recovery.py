#!/usr/bin/env python3
"""Recovery and localisation on `kitchen`: how often a carried camera is found, and how soon; how many particles are needed.

    python3 docs/results/recovery.py build/bin/ppm > docs/results/recovery.md

Needs the data `kitchen` and `house.ply` ($PPM_DATA, default ../shared/data). A camera that is carried is made of links to images: the
images up to one, then those from another one on.
"""
import csv, json, math, os, statistics, subprocess, sys, tempfile

PPM = sys.argv[1]
HOUSE = os.path.abspath(os.path.join(os.environ.get("PPM_DATA") or "../shared/data", "house.ply"))
DATA = os.path.abspath(os.path.join(os.environ.get("PPM_DATA") or "../shared/data", "kitchen"))
GRAPH = """name: carried
seed: 7
nodes:
  - {name: camera, module: source.seven_scenes, params: {path: "PATH", pixel_stride: 2}}
  - {name: init,   module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 3}}
  - {name: motion, module: motion.constant_velocity, in: {frame: camera.frame}, when: {from_frame: 1},
     params: {sigma_t: 2 cm, sigma_r: 1 deg}}
  - {name: align,  module: motion.aligned, in: {frame: camera.frame, view: look}, when: {from_frame: 1}}
  - {name: look,   module: prediction.raster, in: {frame: camera.frame}, when: {from_frame: 1}, params: {stride: 4}}
  - {name: weigh,  module: weighting.robust, in: {frame: camera.frame}, when: {from_frame: 1}}
RECOVER  - {name: pick,   module: resampling.systematic, when: {from_frame: 1}, params: {number: fixed, particles: 3}}
  - {name: view,   module: prediction.raster, in: {frame: camera.frame}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
  - {name: path,   module: sink.trajectory_tum}
  - {name: table,  module: sink.metrics}
  - {name: save,   module: sink.map_ppm, when: {at_end: true}}
"""
RECOVER = """  - {name: recover, module: recovery.relocalize, in: {frame: camera.frame, view: look}, when: {from_frame: 1}}
"""


def pose(image):
    with open(f"{DATA}/frame-{image:06d}.pose.txt") as f:
        return [[float(x) for x in line.split()] for line in f if line.strip()]


def apart(a, b):
    """Distance (m) and angle (degrees) between two images' reference poses."""
    A, B = pose(a), pose(b)
    d = math.dist([r[3] for r in A[:3]], [r[3] for r in B[:3]])
    trace = sum(A[k][i] * B[k][i] for i in range(3) for k in range(3))
    return d, math.degrees(math.acos(max(-1.0, min(1.0, (trace - 1) / 2))))


def link(folder, stretches):
    os.symlink(f"{DATA}/camera-intrinsics.txt", f"{folder}/camera-intrinsics.txt")
    images = [i for first, last in stretches for i in range(first, last + 1)]
    for n, i in enumerate(images):
        for kind in ("color.jpg", "depth.png", "pose.txt"):
            os.symlink(f"{DATA}/frame-{i:06d}.{kind}", f"{folder}/frame-{n:06d}.{kind}")
    return images


def run(graph, out, *options):
    process = subprocess.run([PPM, "run", graph, "--out", out, "--threads", "1", *options], capture_output=True, text=True)
    if process.returncode:
        sys.exit(process.stderr)
    with open(f"{out}/metrics.csv") as f:
        return list(csv.DictReader(f)), json.load(open(f"{out}/run.json"))


def tum(file):
    with open(file) as f:
        return [[float(x) for x in line.split()] for line in f if not line.startswith("#")]


def rotation(line):
    """Of a TUM line, rows."""
    x, y, z, w = line[4:8]
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]


def error_in_own_map(path, truth):
    """Error of the last position, seen from where the path itself was when the camera was nearest to that place before it was carried: drift
    of the map does not count."""
    jump = max(range(1, len(truth)), key=lambda i: math.dist(truth[i][1:4], truth[i - 1][1:4]))
    near = min(range(jump), key=lambda i: math.dist(truth[i][1:4], truth[-1][1:4]))
    step = [b - a for a, b in zip(truth[near][1:4], truth[-1][1:4])]
    R, Q = rotation(truth[near]), rotation(path[near])
    local = [sum(R[k][i] * step[k] for k in range(3)) for i in range(3)]
    expected = [path[near][1 + i] + sum(Q[i][k] * local[k] for k in range(3)) for i in range(3)]
    return math.dist(path[-1][1:4], expected)


def median(values, form="{:.1f}"):
    return form.format(statistics.median(values)) if values else "-"


def carried(first_end, jump_to, stay, recover=True):
    """One run; the frame of the jump, its metrics and the final error against the first frames' alignment."""
    with tempfile.TemporaryDirectory() as folder:
        data, out = f"{folder}/data", f"{folder}/run"
        os.mkdir(data)
        images = link(data, [(0, first_end), (jump_to, jump_to + stay)])
        with open(f"{folder}/graph.yaml", "w") as f:
            f.write(GRAPH.replace("PATH", data).replace("RECOVER", RECOVER if recover else ""))
        rows, _ = run(f"{folder}/graph.yaml", out)
        last = tum(f"{out}/trajectory.tum")[-1]
        reference = pose(images[-1])  # the map begins at the first frame's reference pose
        return rows, math.dist(last[1:4], [r[3] for r in reference[:3]]), first_end + 1


def carried_table():
    print("| carried from frame 430 to | m / deg away | lost declared after, frames | found after, frames | error at the end, cm | without recovery, cm |\n|---|---|---|---|---|---|")
    found = []
    for jump_to in (20, 100, 140, 180, 260):
        rows, error, at = carried(430, jump_to, 60)
        _, bare, _ = carried(430, jump_to, 60, recover=False)
        lost = [i for i, r in enumerate(rows) if r["recover.lost"] not in ("", "0")]
        d, angle = apart(430, jump_to)
        declared, back = (lost[0] - at + 1, lost[-1] - at + 2) if lost else (0, 0)
        found.append(error < 0.1)
        print(f"| {jump_to} | {d:.2f} / {angle:.0f} | {declared or '-'} | {back or '-'} | {100 * error:.1f} | {100 * bare:.1f} |")
    print(f"\nRight at the end, within 10 cm: {sum(found)} of {len(found)}.\n")


def unknown_table():
    print("| shown, up to frame | carried to | m / deg away | frames there | frames that taught the map something | back after, frames | error at the end, cm |\n|---|---|---|---|---|---|---|")
    for end, away in ((100, 830), (100, 850), (60, 800)):
        with tempfile.TemporaryDirectory() as folder:
            data, out = f"{folder}/data", f"{folder}/run"
            os.mkdir(data)
            images = link(data, [(0, end), (away, away + 40), (end - 40, end)])
            with open(f"{folder}/graph.yaml", "w") as f:
                f.write(GRAPH.replace("PATH", data).replace("RECOVER", RECOVER))
            rows, _ = run(f"{folder}/graph.yaml", out)
            there = rows[end + 1:end + 42]
            taught = sum(r["recover.lost"] == "0" and r["recover.unexplained"] == "0" for r in there)
            back = next((i for i, r in enumerate(rows[end + 42:]) if r["recover.lost"] == "0"), None)
            error = math.dist(tum(f"{out}/trajectory.tum")[-1][1:4], [r[3] for r in pose(images[-1])[:3]])
            d, angle = apart(end, away)
            print(f"| {end} | {away} | {d:.2f} / {angle:.0f} | 41 | {taught} | {'-' if back is None else back + 1} | {100 * error:.1f} |")
    print()


TRUTH = """name: truth
nodes:
  - {name: camera, module: SOURCE}
  - {name: init,   module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 1}}
  - {name: motion, module: motion.reference_pose, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: path,   module: sink.trajectory_tum}
  - {name: table,  module: sink.metrics}
"""


def house():
    print("| particles | recovery | ends right (within 10 cm in its own map) | errors at the end, cm | frames lost, median |\n|---|---|---|---|---|")
    source = f'source.mesh_scene, params: {{file: "{HOUSE}", plan: kidnap, seed: SEED}}'
    kitchen = 'source.seven_scenes, params: {path: "PATH", pixel_stride: 2}'
    with tempfile.TemporaryDirectory() as folder:
        graph, out = f"{folder}/graph.yaml", f"{folder}/run"
        with open(graph, "w") as f:
            f.write(TRUTH.replace("SOURCE", source.replace("SEED", "1")))
        run(graph, out)
        truth = tum(f"{out}/trajectory.tum")
        for particles, recover in ((1, False), (5, False), (1, True), (5, True)):
            errors, frames = [], []
            for seed in (1, 2, 3):
                text = GRAPH.replace("RECOVER", RECOVER if recover else "").replace("particles: 3", f"particles: {particles}")
                with open(graph, "w") as f:
                    f.write(text.replace(kitchen, source.replace("SEED", str(seed))))
                rows, _ = run(graph, out, "--seed", str(seed))
                errors.append(error_in_own_map(tum(f"{out}/trajectory.tum"), truth))
                frames.append(sum(r.get("recover.lost") == "1" for r in rows))
            right = sum(e < 0.1 for e in errors)
            print(f"| {particles} | {'yes' if recover else 'no'} | {right} of {len(errors)} | {', '.join(f'{100 * e:.1f}' for e in errors)} | "
                  f"{statistics.median(frames) if recover else '-'} |", flush=True)
    print()


def localize():
    with tempfile.TemporaryDirectory() as folder:
        run("configs/kitchen_mapping.yaml", f"{folder}/map", "--set", f"camera.path={DATA}")
        first, errors, ms = [], [], []
        starts = range(11, 1000, 47)
        for start in starts:
            out = f"{folder}/run"
            rows, report = run("configs/kitchen_localize.yaml", out, "--set", f"camera.path={DATA}", "--set", f"camera.first={start}", "--set",
                               f"init.path={folder}/map", "--set", f"recover.path={folder}/map", "--frames", "12", "--set", f"camera.last={min(999, start + 11)}")
            searched = next((i for i, r in enumerate(rows) if r["recover.accepted"] not in ("", "0")), None)
            if searched is not None:
                first.append(searched + 1)
            ms.append(report["nodes"]["recover"]["ms_p99"])
            last = tum(f"{out}/trajectory.tum")[-1]
            image = start + len(rows) - 1
            errors.append(math.dist(last[1:4], [r[3] for r in pose(image)[:3]]))
        right = sum(e < 0.06 for e in errors)
        print(f"{len(errors)} starts, every 47th image: {right} end within 6 cm of the reference; the first place was accepted in frame "
              f"{median(first, '{:.0f}')} (median; latest {max(first)}); error median {100 * statistics.median(errors):.1f} cm, "
              f"largest {100 * max(errors):.1f} cm; a frame of the search takes {statistics.median(ms):.0f} ms on one thread.\n")


def numbers():
    print("| resampling | particles: mean, most | ATE, cm: seeds 7, 8 | ESS / particles |\n|---|---|---|---|")
    for name, options in (
            ("kept, 100", []), ("kept, 300", ["init.particles=300"]),
            ("kld, 20 to 500", ["pick.number=kld"]),
            ("need, 50 to 500", ["pick.number=need", "pick.least=50", "pick.outliers_few=0.02", "pick.outliers_many=0.06"])):
        ates, count, share = [], [], []
        for seed in (7, 8):
            with tempfile.TemporaryDirectory() as folder:
                flags = [x for o in options for x in ("--set", o)]
                rows, report = run("docs/results/recovery_prior.yaml", f"{folder}/run", "--set", f"camera.path={DATA}", "--set", "camera.last=199", "--seed", str(seed), *flags)
                ates.append(100 * report["trajectory"]["ate_rmse_m"])
                for r in rows:
                    if r["pick.particles"]:
                        count.append(float(r["pick.particles"]))
                        share.append(float(r["pick.ess"]) / count[-1])
        print(f"| {name} | {statistics.mean(count):.0f}, {max(count):.0f} | {', '.join(f'{a:.1f}' for a in ates)} | {statistics.mean(share):.2f} |")
    print()


def tempers():
    print("| weighting | ATE, cm: seeds 7, 8 | ESS / particles: mean, least | exponent: median, least |\n|---|---|---|---|")
    for name, options in (("temper 1", ["weigh.temper=1"]), ("temper .03", []), ("temper 1, ess_target .2", ["weigh.temper=1", "weigh.ess_target=0.2", "weigh.temper_least=0.001"]),
                          ("temper 1, ess_target .5", ["weigh.temper=1", "weigh.ess_target=0.5", "weigh.temper_least=0.001"]),
                          ("temper .03, ess_target .2", ["weigh.ess_target=0.2"])):
        ates, share, exponent = [], [], []
        for seed in (7, 8):
            with tempfile.TemporaryDirectory() as folder:
                flags = [x for o in options for x in ("--set", o)]
                rows, report = run("docs/results/recovery_prior.yaml", f"{folder}/run", "--set", f"camera.path={DATA}", "--set", "camera.last=199", "--seed", str(seed), *flags)
                ates.append(100 * report["trajectory"]["ate_rmse_m"])
                share += [float(r["weigh.ess"]) / 100 for r in rows if r["weigh.ess"]]
                exponent += [float(r["weigh.temper"]) for r in rows if r.get("weigh.temper")]
        e = f"{statistics.median(exponent):.3f}, {min(exponent):.3f}" if exponent else "-"
        print(f"| {name} | {', '.join(f'{a:.1f}' for a in ates)} | {statistics.mean(share):.2f}, {min(share):.2f} | {e} |")
    print()


print("# Lost and found, and how many particles, on `kitchen`\n\nWritten by `python3 docs/results/recovery.py build/bin/ppm`; one thread. What is measured: [particles](../particles.md), "
      "[localisation](../localization.md).\nErrors are distances of the last pose from the data set's reference, in the map that began at the reference's first pose, drift included.\n")
print("## A camera carried to a place that the map has\n\nImages 0 to 430, then others of the same kitchen; three particles with maps of their own.\n")
carried_table()
print("## A camera carried to a place that the map does not have, and back\n")
unknown_table()
print("## A camera carried through the simulated house\n\n`source.mesh_scene` with `plan: kidnap`: from the room into the bedroom, and all at once back.\n")
house()
print("## A start that is not known, in the map of `kitchen_mapping`\n\n`configs/kitchen_localize.yaml`: 12 images from each start.\n")
localize()
print("## How many particles, where the motion prior is the proposal\n\n"
      "[recovery_prior.yaml](recovery_prior.yaml) (constant velocity, no alignment), 200 images: here the number of particles decides.\n")
numbers()
print("## Tempering by a target for the ESS\n\nThe same graph, 100 particles.\n")
tempers()
