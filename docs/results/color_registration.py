#!/usr/bin/env python3
"""How far the colour images of a 7-Scenes folder are from its depth images, and which camera mends it.

Points of frame i are projected into frames i + 12, 25 and 50 with the reference poses, and the intensities that the two
colour images show there are compared, after one gain a pair (automatic exposure). Fitted by least squares with Huber's
weights (0.05). Prints a table.  color_registration.py FOLDER
"""
import sys

import numpy as np
from PIL import Image, ImageFilter

FOLDER = sys.argv[1]
K = np.loadtxt(f"{FOLDER}/camera-intrinsics.txt")
F, CX, CY = K[0, 0], K[0, 2], K[1, 2]
HUBER = 0.05
STEPS = np.array([0.002, 0.3, 0.3, 0.003, 0.003, 0.003])  # of the fit's parameters: log focal, centre px, offset m


def load(i, cache={}):
    if i not in cache:
        stem = f"{FOLDER}/frame-{i:06d}"
        depth = np.array(Image.open(stem + ".depth.png")) / 1000.0
        depth[(depth == 0) | (depth > 60)] = np.nan
        gray = Image.open(stem + ".color.jpg").convert("L").filter(ImageFilter.GaussianBlur(1))
        cache[i] = depth, np.array(gray) / 255.0, np.loadtxt(stem + ".pose.txt")
    return cache[i]


def bilinear(image, x, y):
    rows, cols = image.shape
    x0, y0 = np.clip(np.floor(x).astype(int), 0, cols - 2), np.clip(np.floor(y).astype(int), 0, rows - 2)
    a, b = x - x0, y - y0
    value = (1 - b) * ((1 - a) * image[y0, x0] + a * image[y0, x0 + 1]) + \
        b * ((1 - a) * image[y0 + 1, x0] + a * image[y0 + 1, x0 + 1])
    value[(x < 0) | (y < 0) | (x > cols - 1) | (y > rows - 1)] = np.nan
    return value


def at_jump(depth, x, y):
    around = [np.abs(depth[y + dy, x + dx] - depth[y, x]) for dx, dy in ((-3, 0), (3, 0), (0, -3), (0, 3))]
    return ~(np.max(around, axis=0) < 0.05)


def common_points(i, j):
    """Points that both frames measured, away from depth jumps, in either camera's frame [3, n], and the two images."""
    (di, ci, Ti), (dj, cj, Tj) = load(i), load(j)
    rows, cols = di.shape
    y, x = [g.ravel() for g in np.mgrid[4:rows - 4:5, 4:cols - 4:5]]
    P = di[y, x] * np.stack([(x - CX) / F, (y - CY) / F, np.ones(x.size)])
    T = np.linalg.inv(Tj) @ Ti
    Q = T[:3, :3] @ P + T[:3, 3:]
    with np.errstate(invalid="ignore"):
        u, v = F * Q[0] / Q[2] + CX, F * Q[1] / Q[2] + CY
        inside = (Q[2] > 0.3) & (u > 3) & (v > 3) & (u < cols - 4) & (v < rows - 4)
        u, v = [np.where(inside, np.round(w), 10).astype(int) for w in (u, v)]
        seen = inside & (np.abs(dj[v, u] - Q[2]) < 0.02) & ~at_jump(di, x, y) & ~at_jump(dj, u, v)
    return P[:, seen], Q[:, seen], ci, cj


def color_of(parameters, points, image):
    scale, dx, dy, *offset = parameters
    p = points + np.array(offset)[:, None]
    f = F * np.exp(scale)
    return bilinear(image, f * p[0] / p[2] + CX + dx, f * p[1] / p[2] + CY + dy)


def residuals(parameters, pairs, gains=None):
    out = []
    for P, Q, ci, cj in pairs:
        a, b = color_of(parameters, P, ci), color_of(parameters, Q, cj)
        usable = (a > 0.05) & (b > 0.05) & (a < 0.97) & (b < 0.97)
        gain = np.median(np.log(a[usable] / b[usable]))
        if gains is not None:
            gains.append(gain)
        out.append(a - b * np.exp(gain))
    return np.concatenate(out)


def cost(parameters, pairs):
    a = np.abs(residuals(parameters, pairs))
    a = a[np.isfinite(a)]
    return np.mean(np.where(a < HUBER, a * a / 2, HUBER * (a - HUBER / 2)))


def fit(start, free, pairs):
    p, damping = np.array(start, float), 1e-3
    best = cost(p, pairs)
    for _ in range(12):
        r = residuals(p, pairs)
        J = np.array([(residuals(p + h, pairs) - residuals(p - h, pairs)) / (2 * STEPS[k])
                      for k in free for h in [STEPS * (np.arange(6) == k)]])
        known = np.isfinite(r) & np.all(np.isfinite(J), axis=0)
        w = 1 / np.maximum(1, np.abs(r[known]) / HUBER)
        A = (J[:, known] * w) @ J[:, known].T
        step = np.linalg.solve(A + damping * np.diag(np.diag(A)), (J[:, known] * w) @ r[known])
        trial = p.copy()
        trial[free] -= step
        if cost(trial, pairs) < best:
            p, best, damping = trial, cost(trial, pairs), damping / 3
        else:
            damping *= 10
    return p


def main():
    pairs = [common_points(i, i + d) for i in range(0, 930, 30) for d in (12, 25, 50)]
    pairs = [p for p in pairs if p[0].shape[1] > 300]
    gains = []
    residuals(np.zeros(6), pairs, gains)
    print(f"{len(pairs)} pairs of frames, {sum(p[0].shape[1] for p in pairs)} points. "
          f"Gain between the two: median |log| {np.median(np.abs(gains)):.3f}, most {np.max(np.abs(gains)):.2f}.\n")
    nominal = np.array([np.log(525 / 585), 0, 0, -0.025, 0, 0])
    focal = nominal * (np.arange(6) == 0)
    print("| colour camera | focal, px | centre off, px | depth camera in its frame, cm | median | RMS | Huber's cost, 1e-3 |")
    print("|---|---|---|---|---|---|---|")
    for name, p in (("as the depth camera", np.zeros(6)), ("Kinect's focal length", focal), ("Kinect's, 2.5 cm aside", nominal),
                    ("fit of the focal length", fit(focal, [0], pairs)),
                    ("fit of all", fit(nominal, [0, 1, 2, 3, 4, 5], pairs))):
        r = np.abs(residuals(p, pairs))
        r = r[np.isfinite(r)]
        print(f"| {name} | {F * np.exp(p[0]):.1f} | {p[1]:.1f}, {p[2]:.1f} | {100 * p[3]:.1f}, {100 * p[4]:.1f}, {100 * p[5]:.1f} "
              f"| {np.median(r):.4f} | {np.sqrt(np.mean(np.minimum(r, 0.2) ** 2)):.4f} | {1000 * cost(p, pairs):.2f} |")


main()
