# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact distances used as ground truth: to ellipsoids, curves and triangles. Arrays in, arrays out."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Array = NDArray[np.float64]


def to_ellipsoid(points: Array, semi_axes: tuple[float, ...]) -> Array:
    """Unsigned distance of (n, d) points to the boundary of an axis-aligned ellipsoid (or ellipse, d = 2).

    The foot point is x_i = e_i^2 y_i / (s + e_i^2 - e_min^2) where s > 0 is the root of a falling function;
    s instead of Lagrange's t keeps all digits when the foot leaves the shortest axis' plane.
    """
    e = np.asarray(semi_axes, dtype=float)
    y = np.abs(np.asarray(points, dtype=float))
    shortest = int(np.argmin(e))
    y[:, shortest] = np.maximum(y[:, shortest], 1e-30 * e[shortest])
    gap = e**2 - e[shortest] ** 2
    low = e[shortest] * y[:, shortest]
    high = np.linalg.norm(e * y, axis=1) + low
    for _ in range(220):
        middle = np.where(low * 1e3 < high, np.sqrt(low * high), 0.5 * (low + high))
        outside = np.sum((e * y / (middle[:, None] + gap)) ** 2, axis=1) > 1.0
        low, high = np.where(outside, middle, low), np.where(outside, high, middle)
    foot = e**2 * y / (0.5 * (low + high)[:, None] + gap)
    return np.linalg.norm(foot - y, axis=1)


def to_segment(points: Array, a: Array, b: Array) -> Array:
    """Distance of (n, 3) points to the segments a, b, each (3,) or (n, 3)."""
    direction = b - a
    length = np.maximum(np.sum(direction * direction, axis=-1), np.finfo(float).tiny)
    t = np.clip(np.sum((points - a) * direction, axis=-1) / length, 0.0, 1.0)
    return np.linalg.norm(points - a - t[..., None] * direction, axis=-1)


def to_curve(
    points: Array, curve: Callable, tangent: Callable, period: float, steps: int = 20000
) -> Array:
    """Distance of (n, 3) points to a smooth closed curve t -> curve(t) of the given period."""
    grid = np.linspace(0.0, period, steps, endpoint=False)
    _, nearest = cKDTree(curve(grid)).query(points)
    t, half = grid[nearest], period / steps
    low, high = t - half, t + half
    for _ in range(50):
        t = 0.5 * (low + high)
        behind = np.sum((curve(t) - points) * tangent(t), axis=1) < 0.0
        low, high = np.where(behind, t, low), np.where(behind, high, t)
    return np.linalg.norm(curve(t) - points, axis=1)


def to_triangle(points: Array, triangle: Array) -> Array:
    """Distance of (n, 3) points to one triangle each, (n, 3, 3), or to one for all, (3, 3)."""
    triangle = np.broadcast_to(triangle, (len(points), 3, 3))
    a, b, c = triangle[:, 0], triangle[:, 1], triangle[:, 2]
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    flat = length <= np.finfo(float).tiny
    unit = normal / np.where(flat, 1.0, length)[:, None]
    over = ~flat
    for start, end in ((a, b), (b, c), (c, a)):
        over &= np.einsum("ij,ij->i", np.cross(unit, end - start), points - start) >= 0.0
    plane = np.abs(np.einsum("ij,ij->i", unit, points - a))
    edge = np.minimum(
        to_segment(points, a, b), np.minimum(to_segment(points, b, c), to_segment(points, c, a))
    )
    return np.where(over, plane, edge)


def to_triangles(points: Array, triangles: Array) -> Array:
    """Distance of (n, 3) points to the union of (m, 3, 3) triangles; exact.

    Triangles are binned by size, so that a KD-tree of centroids bounds the search well in every bin.
    """
    centroid = triangles.mean(axis=1)
    radius = np.linalg.norm(triangles - centroid[:, None], axis=2).max(axis=1)
    best = _nearest_corner(points, triangles)
    bins = np.floor(np.log2(np.maximum(radius, radius.max() * 1e-6)))
    for value in np.unique(bins):
        rows = np.flatnonzero(bins == value)
        tree = cKDTree(centroid[rows])
        found = tree.query_ball_point(points, best + radius[rows].max())
        best = np.minimum(best, _best_of_lists(points, triangles[rows], found))
    return best


def _nearest_corner(points: Array, triangles: Array) -> Array:
    corner_distance, corner = cKDTree(triangles.reshape(-1, 3)).query(points)
    return np.minimum(corner_distance, to_triangle(points, triangles[corner // 3]))


def _best_of_lists(points: Array, triangles: Array, lists: NDArray) -> Array:
    counts = np.array([len(ids) for ids in lists])
    best = np.full(len(points), np.inf)
    rows = np.flatnonzero(counts)
    for chunk in np.array_split(rows, max(1, int(counts.sum()) // 2_000_000)):
        if len(chunk) == 0:
            continue
        owner = np.repeat(chunk, counts[chunk])
        ids = np.concatenate([lists[row] for row in chunk]).astype(int)
        distance = to_triangle(points[owner], triangles[ids])
        starts = np.concatenate(([0], np.cumsum(counts[chunk])[:-1]))
        best[chunk] = np.minimum.reduceat(distance, starts)
    return best


def points_on_triangles(triangles: Array, count: int, rng: np.random.Generator) -> Array:
    """(count, 3) area-uniform random points of (m, 3, 3) triangles."""
    area = np.linalg.norm(
        np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1
    )
    pick = rng.choice(len(triangles), size=count, p=area / area.sum())
    u, v = rng.random((2, count))
    flip = u + v > 1.0
    u, v = np.where(flip, 1.0 - u, u), np.where(flip, 1.0 - v, v)
    a, b, c = triangles[pick, 0], triangles[pick, 1], triangles[pick, 2]
    return a + u[:, None] * (b - a) + v[:, None] * (c - a)
