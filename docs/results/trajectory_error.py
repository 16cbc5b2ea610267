"""Trajectory errors by the public definitions, written from these alone, to compare with `ppm evaluate trajectory`.

    trajectory_error.py ESTIMATED REFERENCE      files in TUM format; prints JSON

"paper" is Sturm et al., IROS 2012, section IV; "tools" is what the TUM RGB-D benchmark's evaluate_ate.py and evaluate_rpe.py
(with --fixed_delta --delta 1 --delta_unit f) compute: the same absolute errors, and relative ones composed in the other order and
without the last pose.
"""
import json
import sys

import numpy as np

MAX_DT = 0.02


def read(file):
    rows = np.loadtxt(file, ndmin=2)
    poses = []
    for x, y, z, *q in rows[:, 1:]:
        i, j, k, w = np.array(q) / np.linalg.norm(q)
        pose = np.eye(4)
        pose[:3, :3] = [[1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)],
                        [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)],
                        [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)]]
        pose[:3, 3] = x, y, z
        poses.append(pose)
    return rows[:, 0], np.array(poses)


def associate(a, b):
    """Nearest stamps first, each once: pairs of indices, ascending."""
    dt = np.abs(a[:, None] - b[None, :])
    pairs, rows, columns = [], set(), set()
    for i, j in sorted(zip(*np.nonzero(dt <= MAX_DT)), key=lambda ij: dt[ij]):
        if i not in rows and j not in columns:
            pairs.append((i, j))
            rows.add(i)
            columns.add(j)
    return sorted(pairs)


def absolute(estimated, reference):
    """Lengths of the errors of translation after the best rigid motion (Horn 1987 by singular values: Umeyama 1991)."""
    p, q = estimated[:, :3, 3], reference[:, :3, 3]
    u, _, vt = np.linalg.svd((q - q.mean(0)).T @ (p - p.mean(0)))
    R = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
    return np.linalg.norm((p - p.mean(0)) @ R.T - (q - q.mean(0)), axis=1)


def steps(poses):
    return np.array([np.linalg.inv(a) @ b for a, b in zip(poses[:-1], poses[1:])])


def angle(T):
    """As the sine of the half angle, exact for small ones."""
    R = T[:3, :3]
    half = np.linalg.norm(R - np.eye(3)) / np.sqrt(8)
    return np.degrees(2 * np.arcsin(min(half, 1.0)))


def statistics(name, unit, errors):
    return {f"{name}_rmse_{unit}": float(np.sqrt(np.mean(errors ** 2))), f"{name}_mean_{unit}": float(np.mean(errors)),
            f"{name}_median_{unit}": float(np.median(errors)), f"{name}_max_{unit}": float(np.max(errors))}


def relative(errors):
    return {**statistics("rpe_trans", "m", np.array([np.linalg.norm(e[:3, 3]) for e in errors])),
            **statistics("rpe_rot", "deg", np.array([angle(e) for e in errors]))}


(t_estimated, estimated), (t_reference, reference) = read(sys.argv[1]), read(sys.argv[2])
pairs = associate(t_estimated, t_reference)
P, Q = estimated[[i for i, _ in pairs]], reference[[j for _, j in pairs]]
ate = statistics("ate", "m", absolute(P, Q))
p, q = steps(P), steps(Q)
print(json.dumps({
    "paper": {"pairs": len(pairs), **ate, **relative([np.linalg.inv(b) @ a for a, b in zip(p, q)])},
    "tools": {"pairs": len(pairs), **ate, **relative([a @ np.linalg.inv(b) for a, b in zip(p[:-1], q[:-1])])}}, indent=1))
