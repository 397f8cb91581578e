# SPDX-License-Identifier: GPL-3.0-or-later
"""The smooth fans of a surface: the corners of triangles round a vertex that no sharp edge divides.

A vertex inside a smooth part has one fan, one on an edge of a plate has two, a corner of a cube three. Each has a
normal of its own, so walls that meet at a vertex can be moved by different amounts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..shape.triangles import unit_normals
from ..small_matrices import shortest_solutions, summed
from ..united import united

# Directions in which the normals at a vertex differ by less than this share are left alone: a vertex between two
# nearly opposite walls, as at the tip of a blade, would run far away to offset both.
_OPPOSITE = 0.05  # chosen: unseen


@dataclass(frozen=True, eq=False)
class Fans:
    """The fans of a triangle mesh."""

    of_corners: Longs  # (m, 3) The fan of each corner of each triangle
    vertex: Longs  # (k,)
    normal: Floats  # (k, 3) Unit, outward; zero where all triangles are without area
    triangle: Longs  # (k,) One of the triangles of each fan

    def of_smooth_parts(self, sharp: Ints) -> Flags:
        """(k,) the fans of parts of the surface that no sharp edge bounds; `sharp` is as of `fans_of`."""
        pairs = np.concatenate((self.of_corners[:, :2], self.of_corners[:, 1:]))
        part = united(len(self.vertex), pairs)
        at_sharp = np.isin(self.vertex, sharp)
        return ~np.isin(part, part[at_sharp])

    def spread(self, points: Floats, amount: Floats, slope: float) -> Floats:
        """(k,) the least amounts nowhere below the given ones that fall by `slope` per length along the fans."""
        one, two = self.of_corners.ravel(), np.roll(self.of_corners, -1, axis=1).ravel()
        ends = points[self.vertex[one]], points[self.vertex[two]]
        fall = slope * np.linalg.norm(ends[0] - ends[1], axis=1)
        start, end = np.concatenate((one, two)), np.concatenate((two, one))
        fall = np.concatenate((fall, fall))
        found, changed = amount.copy(), amount > 0.0
        while changed.any():
            front = changed[start]
            before = found.copy()
            np.maximum.at(found, end[front], found[start[front]] - fall[front])
            changed = found > before
        return found

    def offsets(self, vertices: int, amount: Floats) -> Floats:
        """(vertices, 3) the shortest moves that offset each fan by its amount along its normal."""
        squares = self.normal[:, :, None] * self.normal[:, None, :]
        matrix = summed(self.vertex, squares, vertices)
        wanted = summed(self.vertex, amount[:, None] * self.normal, vertices)
        rows = np.flatnonzero(wanted.any(axis=1))
        moves = np.zeros((vertices, 3))
        moves[rows] = shortest_solutions(matrix[rows], wanted[rows], _OPPOSITE)
        return moves


def fans_of(points: Floats, triangles: Ints, sharp: Ints) -> Fans:
    """The fans of (m, 3) triangles, which look outward; those that meet have the same rows there.

    The (e, 2) ends of the sharp edges are in any order.
    """
    label = united(triangles.size, _corners_beside(triangles, sharp, len(points)))
    first, fan = np.unique(label, return_inverse=True)
    of_corners = fan.reshape(triangles.shape)
    normals, doubled = unit_normals(points[triangles])
    total = summed(of_corners, (normals * doubled[:, None])[:, None, :], len(first))
    length = np.linalg.norm(total, axis=1)
    return Fans(
        of_corners=of_corners,
        vertex=triangles.ravel()[first].astype(np.int64),
        normal=total / np.where(length > 0.0, length, 1.0)[:, None],
        triangle=first // 3,
    )


def _corners_beside(triangles: Ints, sharp: Ints, count: int) -> Longs:
    """(p, 2) corners, counted through all triangles, at the same end of an edge that two triangles share smoothly."""
    corner = np.arange(triangles.size).reshape(triangles.shape)
    following = np.roll(triangles, -1, axis=1).astype(np.int64)
    low, high = np.minimum(triangles, following), np.maximum(triangles, following)
    key = (low * count + high).ravel()
    order = np.argsort(key, kind="stable")
    unique, begin, uses = np.unique(key[order], return_index=True, return_counts=True)
    sharp_keys = np.sort(sharp, axis=1).astype(np.int64) @ np.array([count, 1])
    begin = begin[(uses == 2) & ~np.isin(unique, sharp_keys)]
    one, two = order[begin], order[begin + 1]
    after = np.roll(corner, -1, axis=1).ravel()
    same_way = triangles.ravel()[one] == triangles.ravel()[two]
    other_start, other_end = (
        np.where(same_way, two, after[two]),
        np.where(same_way, after[two], two),
    )
    starts, ends = np.column_stack((one, other_start)), np.column_stack((after[one], other_end))
    return np.concatenate((starts, ends))
