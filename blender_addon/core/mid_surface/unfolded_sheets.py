# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets without folds: beside rims that were carried on to walls, triangles may have turned over."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..small_matrices import dot, summed

_ROUNDS = 30  # at most; a fold goes in a few, and what is left lies between vertices that stay


def unfolded(
    vertices: Floats,
    triangles: Ints,
    normals: Floats,
    stays: Flags,
    within_planes: Callable[[Longs, Floats], Floats],
) -> Floats:
    """Move vertices of triangles that are turned over towards the middle of those around them.

    `normals` (t, 3, 3) are those of the sheet at the corners of each triangle; the vertices at rims stay, and the
    others move `within_planes`, which takes (k,) vertices and (k, 3) ways: along their sheet, or where sheets meet.
    """
    found = vertices.copy()
    upward = normals.sum(axis=1)
    near = np.ones(len(triangles), bool)
    for _ in range(_ROUNDS):
        rows = np.flatnonzero(near)
        a, b, c = (found[triangles[rows, corner]] for corner in range(3))
        folded = rows[dot(np.cross(b - a, c - a), upward[rows]) < 0.0]
        moves = np.zeros(len(found), bool)
        moves[triangles[folded]] = True
        moves &= ~stays
        if not moves.any():
            break
        near = moves[triangles].any(axis=1)  # no other triangle changes
        vertex = np.flatnonzero(moves)
        found[vertex] += within_planes(vertex, _to_middle(found, triangles[near])[vertex])
    return found


def _to_middle(vertices: Floats, triangles: Ints) -> Floats:
    """(v, 3) the way from each vertex to the mean of those around it in triangles."""
    rows = np.stack((triangles, triangles))
    others = np.stack([np.roll(triangles, step, axis=1) for step in (1, 2)])
    total = np.bincount(rows.ravel(), minlength=len(vertices))
    sums = summed(rows, vertices[others], len(vertices))
    return sums / np.maximum(total, 1)[:, None] - vertices
