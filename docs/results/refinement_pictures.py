#!/usr/bin/env python3
"""Draws base meshes from one camera pose, coloured by the offset that texels add at the vertices.

refinement_pictures.py OUT.png TRAJECTORY.tum POSE FOCAL TITLE=MESH.ply...
POSE: number of the pose in the trajectory. FOCAL: fx/cols,fy/cols; a negative fy for images whose rows run upwards."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection


def read_ply(path):
    data = open(path, "rb").read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode().split("\n")
    vertices, faces = (int(line.split()[2]) for line in header if line.startswith("element"))
    properties = [line.split()[2] for line in header if line.startswith("property float")]
    table = np.frombuffer(data, "<f4", vertices * len(properties), end).reshape(vertices, -1)
    face = np.frombuffer(data, [("n", "u1"), ("v", "<i4", 3)], faces, end + table.nbytes)["v"]
    return table[:, :3], table[:, properties.index("mean")], face


def pose(path, number):
    rows = [line.split() for line in open(path) if not line.startswith("#")]
    t, q = np.array(rows[number][1:4], float), np.array(rows[number][4:8], float)
    x, y, z, w = q
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return rotation, t


def draw(axes, ply, rotation, t, focal):
    position, mean, face = read_ply(ply)
    p = (position - t) @ rotation
    corner = p[face]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    seen = (corner[:, :, 2].min(1) > 0.2) & ((normal * corner[:, 0]).sum(1) < 0)
    corner, offset = corner[seen], 100 * mean[face][seen].mean(1)
    order = np.argsort(-corner[:, :, 2].mean(1))
    image = corner[..., :2] / corner[..., 2:] * np.array(focal)
    shapes = PolyCollection(image[order], array=offset[order], cmap="coolwarm", edgecolors="black", linewidths=0.25)
    shapes.set_clim(-3, 3)
    axes.add_collection(shapes)
    axes.set_xlim(-0.5, 0.5)
    axes.set_ylim(0.375, -0.375)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    return shapes


def main(out, trajectory, number, focal, *meshes):
    rotation, t = pose(trajectory, int(number))
    focal = [float(f) for f in focal.split(",")]
    figure, axes = plt.subplots(1, len(meshes), figsize=(5.2 * len(meshes), 4.2), layout="constrained")
    for ax, item in zip(axes.flat, meshes):
        title, ply = item.split("=", 1)
        shapes = draw(ax, ply, rotation, t, focal)
        ax.set_title(title, fontsize=9)
    figure.colorbar(shapes, ax=axes, shrink=0.6, label="offset of the described surface, cm")
    figure.savefig(out, dpi=72)


main(*sys.argv[1:])
