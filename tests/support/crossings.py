# SPDX-License-Identifier: GPL-3.0-or-later
"""Inside or outside of closed triangles by counting signed crossings of a ray; shares nothing with the product.

All rays go the same way. Which of two triangles a ray through their common edge crosses is decided once per edge and
query, by the sign of one number, so that no ray slips through between them.
"""

import numpy as np
from numpy.typing import NDArray

from .crossing_triangles import ranks

Array = NDArray[np.float64]
Ints = NDArray[np.integer]

PAIRS = 4_000_000  # of queries and triangles at a time


def winding(queries: Array, vertices: Array, triangles: Ints, seed: int = 0) -> NDArray[np.int64]:
    """(q,) winding numbers of closed triangles, along a random direction; any integer on the surface itself."""
    frame, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    frame[:, 0] *= np.linalg.det(frame)
    corners, rows = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    triangles = rows.reshape(-1)[triangles]
    queries, corners = queries @ frame, corners @ frame
    cells = _Cells(corners, triangles)
    found = np.zeros(len(queries), dtype=np.int64)
    for query, triangle in cells.pairs(queries):
        np.add.at(found, query, _crossings(queries[query], corners, triangles[triangle]))
    return found


def inside(queries: Array, vertices: Array, triangles: Ints) -> NDArray[np.bool_]:
    return winding(queries, vertices, triangles) > 0


class _Cells:
    """Triangles by the cells of a square grid that their bounding boxes meet, seen from above."""

    def __init__(self, corners: Array, triangles: Ints) -> None:
        self.low = corners[:, :2].min(axis=0)
        self.count = int(np.clip(np.sqrt(len(triangles)), 1, 400))
        self.size = np.maximum(np.ptp(corners[:, :2], axis=0), 1e-300) / self.count
        boxes = corners[triangles][:, :, :2]
        first, last = self._cell(boxes.min(axis=1)), self._cell(boxes.max(axis=1))
        wide = last - first + 1
        owner = np.repeat(np.arange(len(triangles)), wide.prod(axis=1))
        rank = ranks(wide.prod(axis=1))
        cell = first[owner] + np.column_stack((rank // wide[owner, 1], rank % wide[owner, 1]))
        cell = cell[:, 0] * self.count + cell[:, 1]
        self.triangle = owner[np.argsort(cell, kind="stable")]
        self.start = np.searchsorted(np.sort(cell), np.arange(self.count**2 + 1))

    def _cell(self, flat: Array) -> Ints:
        return np.clip(((flat - self.low) / self.size).astype(np.int64), 0, self.count - 1)

    def pairs(self, queries: Array):
        """Chunks of (query, triangle)."""
        flat = queries[:, :2]
        reach = self.low + self.count * self.size
        rows = np.flatnonzero(np.all((flat >= self.low) & (flat <= reach), axis=1))
        cell = self._cell(flat[rows]) @ (self.count, 1)
        counts = self.start[cell + 1] - self.start[cell]
        ends = np.cumsum(counts)
        for chunk in np.split(np.arange(len(rows)), np.searchsorted(ends, _steps(ends))):
            owner = np.repeat(chunk, counts[chunk])
            yield rows[owner], self.triangle[self.start[cell[owner]] + ranks(counts[chunk])]


def _steps(ends: Ints) -> Ints:
    return np.arange(PAIRS, ends[-1] if len(ends) else 0, PAIRS)


def _crossings(queries: Array, corners: Array, triangles: Ints) -> Ints:
    """+1 where the ray upward from a query leaves through its triangle, -1 where it enters, else 0."""
    turns = np.stack(
        [_turn(queries, corners, triangles[:, i], triangles[:, (i + 1) % 3]) for i in range(3)]
    )
    left = turns >= 0.0
    reverse = np.roll(triangles.T, -1, axis=0) < triangles.T
    left = np.where(reverse, ~left, left)
    sign = np.where(left.all(axis=0), 1, np.where(left.any(axis=0), 0, -1))
    weights = np.abs(np.roll(turns, -1, axis=0))  # each corner's: the turn about the opposite edge
    heights = (weights * corners[triangles, 2].T).sum(axis=0)
    total = weights.sum(axis=0)
    return np.where((total > 0.0) & (heights > queries[:, 2] * total), sign, 0)


def _turn(queries: Array, corners: Array, a: Ints, b: Ints) -> Array:
    """Which side of the edge, from its lower row to its higher one, the query is on."""
    p, q = corners[np.minimum(a, b), :2], corners[np.maximum(a, b), :2]
    x = queries[:, :2]
    return (q[:, 0] - p[:, 0]) * (x[:, 1] - p[:, 1]) - (q[:, 1] - p[:, 1]) * (x[:, 0] - p[:, 0])
