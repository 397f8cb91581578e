# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes cut the faces of a solid, and the loop of cuts round a place is the cross-section there."""

from __future__ import annotations

import math

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..small_matrices import dot, times

_ENDS = np.array([(0, 1), (1, 2), (2, 0)])  # corners of the sides of a triangle


class Faces:
    """These are the faces of a solid, with vertices that coincide as one."""

    def __init__(self, points: Floats, triangles: Ints) -> None:
        self.points, row = np.unique(points, axis=0, return_inverse=True)
        self.triangles = row.reshape(-1)[triangles]
        corners = self.points[self.triangles]
        self._low, self._high = corners.min(axis=1), corners.max(axis=1)

    def near(self, low: Floats, high: Floats) -> Longs:
        """Return the triangles, (m, 3), whose boxes meet the box between two corners."""
        return self.triangles[((self._low <= high) & (self._high >= low)).all(axis=1)]


def section(
    place: Floats, normal: Floats, points: Floats, triangles: Longs, others: Floats
) -> tuple[float, float]:
    """Return the area and the perimeter of the cross-section round a place, or twice nan where there is none.

    There is none where the cuts round the place are not closed, as at an opening of the faces, and where other lines
    pass through the cross-section, too: it is then that of several limbs together.

    Parameters
    ----------
    place : (3,) float64
    normal : (3,) float64
        A unit vector across the plane.
    points : (v, 3) float64
    triangles : (m, 3) integers
        They must name the same row for the same place.
    others : (k, 2, 3) float64
        The segments of other lines.
    """
    frame = _across(normal)
    loops = _loops(*_cuts(times(points - place, np.vstack((frame, normal))), triangles))
    round_it = [loop for loop in loops if _within(np.zeros((1, 2)), loop)[0]]
    if not round_it:
        return math.nan, math.nan
    areas = [_area(loop) for loop in round_it]
    loop = round_it[int(np.argmin(areas))]
    ends = times(others - place, np.vstack((frame, normal)))
    above = ends[..., 2] >= 0.0
    through = ends[above[:, 0] != above[:, 1]]
    if _within(_on_plane(through[:, 0], through[:, 1]), loop).any():
        return math.nan, math.nan
    steps = np.roll(loop, -1, axis=0) - loop
    return min(areas), float(np.linalg.norm(steps, axis=1).sum())


def _across(normal: Floats) -> Floats:
    """Return two unit vectors across a third one, (2, 3)."""
    axis = np.zeros(3)
    axis[np.argmin(np.abs(normal))] = 1.0
    first = np.cross(normal, axis)
    first /= math.sqrt(float(dot(first, first)))
    return np.stack((first, np.cross(normal, first)))


def _cuts(points: Floats, triangles: Longs) -> tuple[Floats, Longs]:
    """Return where a plane cuts sides of triangles, (k, 2), and the two cuts of each triangle that it cuts, (t, 2).

    The plane is that of the first two axes. Points on it count as above it.
    """
    above = points[:, 2] >= 0.0
    count = above[triangles].sum(axis=1)
    cut = triangles[(count > 0) & (count < 3)]
    sides = np.sort(cut[:, _ENDS], axis=2)  # (t, 3, 2)
    sides = sides[above[sides[..., 0]] != above[sides[..., 1]]]  # two of each triangle
    keys, row = np.unique(sides[:, 0] * len(points) + sides[:, 1], return_inverse=True)
    ends = np.column_stack((keys // len(points), keys % len(points)))
    return _on_plane(points[ends[:, 0]], points[ends[:, 1]]), row.reshape(-1, 2)


def _on_plane(a: Floats, b: Floats) -> Floats:
    """Return where segments whose ends are on two sides of the plane meet it, (k, 2)."""
    share = a[:, 2] / (a[:, 2] - b[:, 2])
    return a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2])


def _loops(places: Floats, pairs: Longs) -> list[Floats]:
    """Return the closed polygons, (n, 2) each, that segments between places form; forks and open ends have none."""
    meeting: list[list[int]] = [[] for _ in places]
    for segment, (a, b) in enumerate(pairs.tolist()):
        meeting[a].append(segment)
        meeting[b].append(segment)
    ends = pairs.tolist()
    used = [False] * len(ends)
    found = []
    for segment, (start, _) in enumerate(ends):
        rows, at = [start], start
        while not used[segment] and len(meeting[at]) == 2:
            used[segment] = True
            a, b = ends[segment]
            at = b if a == at else a
            rows.append(at)
            first, second = meeting[at] if len(meeting[at]) == 2 else (segment, segment)
            segment = second if first == segment else first
        if len(rows) > 3 and at == start:
            found.append(places[rows[:-1]])
    return found


def _area(loop: Floats) -> float:
    x, y = loop.T
    return abs(float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2.0


def _within(places: Floats, loop: Floats) -> Flags:
    """Return which places, (k, 2), are inside of a polygon: a ray from there crosses it an odd number of times."""
    a, b = loop, np.roll(loop, -1, axis=0)
    crossed = (a[:, 1] > places[:, 1, None]) != (b[:, 1] > places[:, 1, None])
    rise = np.where(a[:, 1] == b[:, 1], 1.0, b[:, 1] - a[:, 1])
    at = a[:, 0] + (places[:, 1, None] - a[:, 1]) * ((b[:, 0] - a[:, 0]) / rise)
    return (crossed & (at > places[:, 0, None])).sum(axis=1) % 2 == 1
