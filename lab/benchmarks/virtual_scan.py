# SPDX-License-Identifier: GPL-3.0-or-later
"""A virtual scanner: what views from all around see of a mesh, a point per pixel, with the faults of real scanners."""

from dataclasses import dataclass

import numpy as np

FAR = 2.0  # diagonals from the eye to the middle
AROUND = np.array(
    [x for x in np.indices((3, 3, 3)).reshape(3, -1).T - 1 if np.abs(x).sum() in (1, 3)], float
)


@dataclass(frozen=True)
class Faults:
    """Lengths are in pitches, the distance of pixels at the middle of the mesh; `outliers` is a share of the points."""

    noise: float = 0.0
    step: float = 0.0  # to which depths are rounded
    shift: float = 0.0  # of each view as a whole
    outliers: float = 0.0
    views: int = len(AROUND)  # those that are left out look from below


def scan(points: np.ndarray, triangles: np.ndarray, pitch: float, faults: Faults, seed: int = 1):
    """Return (n, 3) points of all views, merged; `pitch` is a share of the diagonal."""
    rng = np.random.default_rng(seed)
    low, high = points.min(axis=0), points.max(axis=0)
    size = float(np.linalg.norm(high - low))
    step = pitch * size
    merged = []
    for direction in AROUND[np.argsort(-AROUND[:, 2], kind="stable")][: faults.views]:
        eye = (low + high) / 2 + FAR * size * direction / np.linalg.norm(direction)
        rays, depth = seen(points - eye, triangles, -direction, step / (FAR * size))
        if faults.step:
            depth = np.round(depth / (faults.step * step)) * faults.step * step
        depth = depth + rng.normal(size=len(depth)) * faults.noise * step
        away = rng.normal(size=3)
        away *= faults.shift * step / np.linalg.norm(away)
        merged.append(eye + rays * depth[:, None] + away)
    found = np.concatenate(merged)
    strays = rng.uniform(low - 0.1 * (high - low), high + 0.1 * (high - low), (len(found), 3))
    return np.concatenate((found, strays[: int(faults.outliers * len(found))]))


def seen(points: np.ndarray, triangles: np.ndarray, forward: np.ndarray, pixel: float):
    """Return (n, 3) rays of depth 1 and (n,) depths: what an eye in the origin sees; pixels have a size at depth 1.

    Depth is along the axis of view, so its inverse is linear over the picture of a triangle.
    """
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, np.eye(3)[np.argmin(np.abs(forward))])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    z = points @ forward
    flat = np.column_stack((points @ right, points @ up)) / z[:, None] / pixel
    corner, near = flat[triangles], 1 / z[triangles]
    first, last = np.ceil(corner.min(axis=1)).astype(int), np.floor(corner.max(axis=1)).astype(int)
    wide = np.maximum(last - first + 1, 0)
    count = wide.prod(axis=1)
    face = np.repeat(np.arange(len(triangles)), count)
    place = np.arange(len(face)) - np.repeat(np.cumsum(count) - count, count)
    spot = first[face] + np.column_stack((place // wide[face, 1], place % wide[face, 1]))
    share = barycentric(corner[face], spot)
    inside = (share >= 0).all(axis=1)
    face, spot, share = face[inside], spot[inside], share[inside]
    inverse = (share * near[face]).sum(axis=1)
    order = np.lexsort((-inverse, spot[:, 1], spot[:, 0]))
    front = order[np.concatenate(([True], (np.diff(spot[order], axis=0) != 0).any(axis=1)))]
    across = spot[front] * pixel
    return forward + across[:, :1] * right + across[:, 1:] * up, 1 / inverse[front]


def barycentric(corners: np.ndarray, places: np.ndarray) -> np.ndarray:
    """(n, 3) shares of the corners of flat triangles; those of a triangle without area are no numbers."""
    a, b, p = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0], places - corners[:, 0]

    def turn(u, v):
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]

    with np.errstate(divide="ignore", invalid="ignore"):
        second, third = turn(p, b) / turn(a, b), turn(a, p) / turn(a, b)
    return np.column_stack((1 - second - third, second, third))
