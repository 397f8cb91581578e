# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles: their normals and edges, their Euler characteristic, and an even selection of many."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Longs
from ..small_matrices import summed

# At most this number of triangles is measured, which determines shares to a percent.
_LOOKED_AT = 20_000
# A smaller share of the faces, their edges, their area or its samples comes from single ones, as at rims and folds, and
# does not count.
FEW = 0.01  # chosen: unseen


def some_of(count: int) -> NDArray[np.intp]:
    """Return rows of a list of `count` items, (k,), evenly spread; all of them where they are few."""
    return np.unique(np.linspace(0, count - 1, min(count, _LOOKED_AT)).astype(np.intp))


def unit_normals(corners: Floats) -> tuple[Floats, Floats]:
    """(n, 3) the unit normal of each triangle of (n, 3, 3) corners, zero where it has none, and (n,) twice its area."""
    return unit_vectors(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))


def area_vectors(points: Floats, triangles: Ints) -> tuple[Floats, Floats]:
    """(f, 3) the normal of each triangle, twice as long as its area is large, and (n, 3) their sums at each point."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    vectors = cross(b - a, c - a)
    return vectors, summed(triangles, vectors[:, None], len(points))


def unit_vectors(vectors: Floats) -> tuple[Floats, Floats]:
    """(n, 3) vectors of length 1 along others, zero where these are, and (n,) the lengths of these."""
    lengths = np.linalg.norm(vectors, axis=1)
    return vectors / np.where(lengths > 0.0, lengths, 1.0)[:, None], lengths


def cross(a: Floats, b: Floats) -> Floats:
    """Return cross products of rows, (n, 3); NumPy's own function takes several times as long."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.column_stack((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))


def side_keys(faces: Ints | Longs, count: int) -> Longs:
    """Return a number for the edge from each corner of faces to the next, given the number of vertices."""
    start = faces.astype(np.int64)
    end = np.roll(start, -1, axis=1)
    return np.minimum(start, end) * count + np.maximum(start, end)


def equal_pairs(keys: NDArray[np.integer]) -> tuple[Longs, Longs]:
    """Return the rows of each two equal numbers between which, of all rows, no other one is equal, (p,) each."""
    order = np.argsort(keys, kind="stable")
    same = keys[order[:-1]] == keys[order[1:]]
    return order[:-1][same], order[1:][same]


def edges_of(triangles: Ints) -> Ints:
    """Return the edges of triangles, each once, (e, 2)."""
    count = int(triangles.max(initial=0)) + 1
    keys = np.unique(side_keys(triangles, count))
    return np.column_stack(np.divmod(keys, count)).astype(triangles.dtype)


def sides_of(faces: Ints) -> tuple[Longs, Longs, Longs]:
    """Return the edges of faces, (e, 2), the edge from each corner to the next, and the sides of each edge, (e,)."""
    count = int(faces.max(initial=0)) + 1
    keys, edge, uses = np.unique(side_keys(faces, count), return_inverse=True, return_counts=True)
    return np.column_stack(np.divmod(keys, count)), edge.reshape(faces.shape), uses


def euler_characteristic(triangles: Ints) -> int:
    """The vertices less the edges and plus the triangles, which is the pieces less the loops and plus the cavities."""
    return len(np.unique(triangles)) - len(edges_of(triangles)) + len(triangles)
