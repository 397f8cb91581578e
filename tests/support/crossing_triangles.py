# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of triangles of a mesh that cross: an edge of one goes through the inside of the other."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.integer]

MARGIN = 1e-9  # of the diagonal: what is nearer to a plane or to a side only touches
PAIRS = 2_000_000  # at a time


def crossing_pairs(points: Array, triangles: Ints) -> NDArray[np.int64]:
    """(k, 2) rows of triangles without a common vertex that cross by more than rounding, the lower first."""
    margin = MARGIN * float(np.linalg.norm(np.ptp(points, axis=0))) if len(points) else 0.0
    found = [np.empty((0, 2), np.int64)]
    for pairs in _close_pairs(points[triangles]):
        first, second = triangles[pairs[:, 0]], triangles[pairs[:, 1]]
        apart = (first[:, :, None] != second[:, None, :]).all(axis=(1, 2))
        pairs = pairs[apart]
        a, b = points[triangles[pairs[:, 0]]], points[triangles[pairs[:, 1]]]
        found.append(pairs[_pierces(a, b, margin) | _pierces(b, a, margin)])
    return np.unique(np.concatenate(found), axis=0)


def _close_pairs(corners: Array):
    """Chunks of (k, 2) pairs whose boxes meet, from a grid of cells as wide as most boxes."""
    low, high = corners.min(axis=1), corners.max(axis=1)
    if len(corners) == 0:
        return
    wide = max(float(np.quantile((high - low).max(axis=1), 0.9)), float(np.ptp(corners)) / 500)
    first = np.floor((low - low.min(axis=0)) / wide).astype(np.int64)
    count = np.floor((high - low.min(axis=0)) / wide).astype(np.int64) - first + 1
    owner = np.repeat(np.arange(len(corners)), count.prod(axis=1))
    rank = ranks(count.prod(axis=1))
    of = count[owner]
    steps = np.column_stack(
        (rank // (of[:, 1] * of[:, 2]), rank // of[:, 2] % of[:, 1], rank % of[:, 2])
    )
    cell = first[owner] + steps
    _, cell = np.unique(cell, axis=0, return_inverse=True)
    order = np.argsort(cell.reshape(-1), kind="stable")
    yield from _pairs_of_cells(owner[order], np.bincount(cell.reshape(-1)), low, high)


def _pairs_of_cells(owner: Ints, sizes: Ints, low: Array, high: Array):
    """Pairs of triangles of one cell whose boxes meet; those of several cells come more than once."""
    behind = np.repeat(np.cumsum(sizes), sizes) - np.arange(len(owner)) - 1
    ends = np.cumsum(behind)
    cuts = np.searchsorted(ends, np.arange(PAIRS, ends[-1] + 1, PAIRS))
    for rows in np.split(np.arange(len(owner)), cuts):
        left = np.repeat(rows, behind[rows])
        a, b = owner[left], owner[left + 1 + ranks(behind[rows])]
        meet = np.all((low[a] <= high[b]) & (low[b] <= high[a]), axis=1)
        yield np.sort(np.column_stack((a, b))[meet], axis=1)


def ranks(counts: Ints) -> Ints:
    """0 .. counts[0] - 1, 0 .. counts[1] - 1, ..."""
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)


def _pierces(edges_of: Array, triangle: Array, margin: float) -> NDArray[np.bool_]:
    """(k,) an edge of the one triangle goes through the other, farther than the margin from its plane and sides."""
    a, b, c = triangle.transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    unit = normal / np.maximum(area, np.finfo(float).tiny)[:, None]
    height = np.einsum("kij,kj->ki", edges_of - a[:, None], unit)
    found = np.zeros(len(triangle), bool)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        through = np.minimum(height[:, i], height[:, j]) < -margin
        through &= np.maximum(height[:, i], height[:, j]) > margin
        rows = np.flatnonzero(through)
        t = height[rows, i] / (height[rows, i] - height[rows, j])
        at = edges_of[rows, i] + t[:, None] * (edges_of[rows, j] - edges_of[rows, i])
        found[rows] |= _well_inside(at, triangle[rows], unit[rows], margin)
    return found


def _well_inside(at: Array, triangle: Array, unit: Array, margin: float) -> NDArray[np.bool_]:
    inside = np.ones(len(at), bool)
    for i in range(3):
        start, along = triangle[:, i], triangle[:, (i + 1) % 3] - triangle[:, i]
        length = np.maximum(np.linalg.norm(along, axis=1), np.finfo(float).tiny)
        off = np.einsum("ij,ij->i", np.cross(unit, along), at - start) / length
        inside &= off > margin
    return inside
