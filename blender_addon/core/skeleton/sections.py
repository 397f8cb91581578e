# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes cut the faces of a solid, and the loop of cuts round a place is the cross-section there."""

from __future__ import annotations

import math

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..shape.triangles import cross
from ..small_matrices import dot, length_of, times

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
) -> tuple[float, float] | None:
    """Return the area and the perimeter of the cross-section round a place, twice nan where it is unknown.

    It is unknown where other lines pass through the cross-section, too, which is then that of several limbs together.
    There is none where the cuts round the place are not closed, as at an opening of the faces.

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
    frame = np.vstack((_across(normal), normal))
    loops = _loops(*_cuts(place, frame, points, triangles))
    if not loops:
        return None
    areas = [_area(loop) for loop in loops]
    loop = loops[int(np.argmin(areas))]
    above = dot(others - place, normal) >= 0.0
    through = times(others[above[:, 0] != above[:, 1]] - place, frame)
    if _within(_on_plane(through[:, 0], through[:, 1]), loop).any():
        return math.nan, math.nan
    steps = np.roll(loop, -1, axis=0) - loop
    return min(areas), float(np.linalg.norm(steps, axis=1).sum())


def _across(normal: Floats) -> Floats:
    """Return two unit vectors across a third one, (2, 3)."""
    axis = np.zeros(3)
    axis[np.argmin(np.abs(normal))] = 1.0
    first = cross(normal, axis)
    first /= length_of(first)
    return np.concatenate((first, cross(normal, first[0])))


def _cuts(place: Floats, frame: Floats, points: Floats, triangles: Longs) -> tuple[Floats, Longs]:
    """Return where a plane cuts sides of triangles, (k, 2), and the two cuts of each triangle that it cuts, (t, 2).

    The plane is that of the first two axes of the frame, and the place is its origin. Points on it count as above it.
    """
    above = dot(points - place, frame[2]) >= 0.0
    first, second, third = above[triangles].T
    cut = triangles[(first != second) | (second != third)]
    sides = np.sort(cut[:, _ENDS], axis=2)  # (t, 3, 2)
    sides = sides[above[sides[..., 0]] != above[sides[..., 1]]]  # two of each triangle
    keys, row = np.unique(sides[:, 0] * len(points) + sides[:, 1], return_inverse=True)
    ends = times(points[np.stack((keys // len(points), keys % len(points)))] - place, frame)
    return _on_plane(*ends), row.reshape(-1, 2)


def _on_plane(a: Floats, b: Floats) -> Floats:
    """Return where segments whose ends are on two sides of the plane meet it, (k, 2)."""
    share = a[:, 2] / (a[:, 2] - b[:, 2])
    return a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2])


def _loops(places: Floats, pairs: Longs) -> list[Floats]:
    """Return the closed polygons round the origin, (n, 2) each, that segments form; forks and open ends have none."""
    ends = pairs.ravel()  # those of segment i are rows 2 i and 2 i + 1
    last = np.cumsum(np.bincount(ends, minlength=len(places))) - 1
    two = np.argsort(ends, kind="stable")[last[np.diff(last, prepend=-1) == 2, None] - (1, 0)]
    partner = np.full(len(ends), -1)
    partner[two] = two[:, ::-1]
    following, used, found = partner.tolist(), set(), []
    # A polygon round the origin crosses a ray from there.
    for segment in np.flatnonzero(_crossed(np.zeros((1, 2)), *places[pairs.T])[0]).tolist():
        end, rows = 2 * segment, []
        while end >= 0 and end // 2 not in used:
            used.add(end // 2)
            rows.append(end)
            end = following[end ^ 1]
        if len(rows) > 2 and end == 2 * segment:
            found.append(places[ends[rows]])
    return [loop for loop in found if _within(np.zeros((1, 2)), loop)[0]]


def _area(loop: Floats) -> float:
    x, y = loop.T
    return abs(float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2.0


def _within(places: Floats, loop: Floats) -> Flags:
    """Return which places, (k, 2), are inside of a polygon: a ray from there crosses it an odd number of times."""
    return _crossed(places, loop, np.roll(loop, -1, axis=0)).sum(axis=1) % 2 == 1


def _crossed(places: Floats, a: Floats, b: Floats) -> Flags:
    """Return whether the ray along the first axis from each of (k, 2) places crosses each of n segments, (k, n)."""
    crossed = (a[:, 1] > places[:, 1, None]) != (b[:, 1] > places[:, 1, None])
    rise = np.where(a[:, 1] == b[:, 1], 1.0, b[:, 1] - a[:, 1])
    at = a[:, 0] + (places[:, 1, None] - a[:, 1]) * ((b[:, 0] - a[:, 0]) / rise)
    return crossed & (at > places[:, 0, None])
