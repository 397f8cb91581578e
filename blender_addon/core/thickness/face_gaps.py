# SPDX-License-Identifier: GPL-3.0-or-later
"""The gaps between pairs of triangles that do not pass through each other."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..small_matrices import dot


def face_gaps(first: Floats, second: Floats) -> Floats:
    """(p,) the distances of (p, 3, 3) triangles: of a corner from a face, or of two sides from each other."""
    least = np.full(len(first), np.inf)
    for corner in range(3):
        for one, other in ((first, second), (second, first)):
            least = np.minimum(least, _heights(one[:, corner], other))
        for side in range(3):
            least = np.minimum(least, _between_sides(_side(first, corner), _side(second, side)))
    return least


def _side(triangles: Floats, number: int) -> Floats:
    """(p, 2, 3) the ends of a side."""
    return triangles[:, [number, (number + 1) % 3]]


def _heights(points: Floats, triangles: Floats) -> Floats:
    """(p,) how far points are over their triangles; infinite where they are beside these."""
    sides = np.roll(triangles, -1, axis=1) - triangles
    normal = np.cross(sides[:, 0], sides[:, 1])
    size = np.sqrt(dot(normal, normal))
    away = points[:, None] - triangles
    over = (dot(np.cross(sides, away), normal[:, None]) >= 0.0).all(axis=1) & (size > 0.0)
    height = np.abs(dot(away[:, 0], normal)) / np.where(size > 0.0, size, 1.0)
    return np.where(over, height, np.inf)


def _between_sides(one: Floats, other: Floats) -> Floats:
    """(p,) the distances of (p, 2, 3) segments (Ericson 2005, section 5.1.9)."""
    u, v, from_other = one[:, 1] - one[:, 0], other[:, 1] - other[:, 0], one[:, 0] - other[:, 0]
    uu, vv, uv = dot(u, u), dot(v, v), dot(u, v)
    ur, vr = dot(u, from_other), dot(v, from_other)
    at = _share(uv * vr - ur * vv, uu * vv - uv * uv)
    there = _share(uv * at + vr, vv)
    at = _share(uv * there - ur, uu)
    away = from_other + at[:, None] * u - there[:, None] * v
    return np.sqrt(dot(away, away))


def _share(part: Floats, whole: Floats) -> Floats:
    """(p,) a part of a length that is not 0, from 0 to 1."""
    return np.clip(part / np.where(whole > 0.0, whole, np.inf), 0.0, 1.0)
