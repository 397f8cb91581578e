# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines are smoothed as far as their balls allow, and their bends are measured.

The centre line of a solid bends no sharper than its balls, so waves much shorter than the circumference of a ball are
noise of the points. The smooth line is the one with the least sum of squares of deviations and of weighted fourth
differences (Whittaker 1923). A wave that is 0.7 circumferences long loses half its height, and
one twice as long 0.4 %.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..machine import native
from ..small_matrices import dot

_PER_RADIUS = 8  # a mean radius has this many steps
_LEAST, _MOST = 16, 16_384  # a line has this many
_HALVED = 0.7  # waves of this many circumferences lose half their height; chosen: skeleton
_CLIPPED = 2.0, 16.0  # that many radii count as this many steps
_BEYOND = 64  # this many steps beyond an end have an influence
_AROUND = 2  # this many places before and after a place decide how the line bends there


@dataclass(frozen=True, eq=False)
class SmoothLine:
    """A smooth line has places in even steps, from its start to its end."""

    share: Floats  # (n,) The share of the length of the given line before each place, from 0 to 1
    points: Floats  # (n, 3) The ends may be off those of the given line
    radius: Floats  # (n,)
    tangent: Floats  # (n, 3) Unit vectors
    length: float  # The length of the smooth line
    curvature: Floats  # (n,) In the inverse of the unit of lengths
    # (n,) As curvature; it is positive if the line turns like the thread of a usual screw, and
    # means nothing where the curvature is close to 0
    torsion: Floats


def smooth_line(points: Floats, radius: Floats, closed: bool) -> SmoothLine | None:
    """Return a line without the noise of its points, or None if its length is 0 or no number.

    Parameters
    ----------
    points : (n, 3) float64
        The last point of a closed line is its first.
    radius : (n,) float64
        The radii of the balls around the points.
    closed : bool
        The line has no ends.
    """
    marks = marks_of(points)
    length = float(marks[-1])
    if not 0.0 < length < np.inf:
        return None
    share, places = even_places(marks, points, radius)
    count = len(share) - 1
    steps = np.clip(_HALVED * places[:, 3] * (count / length), *_CLIPPED)
    row = np.arange(count + 1)
    if closed:  # three turns: the ends of the first and of the last have no influence on the second
        row, kept = np.arange(3 * count) % count, np.arange(count, 2 * count + 1)
    else:
        kept = row
    unit = (places[row, :3] - points[0]) / length  # neither large nor small lengths overflow
    with native.own_errors() as module:
        smooth = module.smooth_line(unit, steps[row])
    tangent, *bends = (values[kept] for values in _bends(smooth, 1.0 / count))
    line = smooth[kept]
    return SmoothLine(
        share=share,
        points=line * length + points[0],
        radius=places[:, 3],
        tangent=tangent,
        length=float(marks_of(line)[-1]) * length,
        curvature=bends[0] / length,
        torsion=bends[1] / length,
    )


@dataclass(frozen=True, eq=False)
class Course:
    """A line to be made smooth."""

    points: Floats  # (n, 3) The last point of a closed line is its first. The line has a length.
    radius: Floats  # (n,) The radii of the balls around the points
    closed: bool  # The line has no ends


def smooth_between(lines: list[Course]) -> list[tuple[Floats, Floats]]:
    """Return shares and places of smooth lines in even steps, whose ends are those of the given lines.

    Beyond each end a line continues as its own image in the end, so the end stays and its direction is free.

    Returns
    -------
    share : (n,) float64
        As of `SmoothLine`.
    places : (n, 3) float64
        The last place of a closed line is its first; it may be off the given line, as all others.
    """
    found = []
    with native.own_errors() as module:
        for line in lines:
            share, places, steps = _longer(line)
            found.append((share, _shorter(line, module.smooth_line(places, steps), len(share))))
    return found


def _longer(line: Course) -> tuple[Floats, Floats, Floats]:
    """Return shares of a line in even steps, (n,), and places, (m, 3), and steps, (m,), also beyond its ends.

    Places are relative to the first point.
    """
    share, places = even_places(marks_of(line.points), line.points, line.radius)
    count = len(share) - 1
    unit, radius = places[:, :3] - line.points[0], places[:, 3]
    step = float(marks_of(line.points)[-1]) / count
    steps = np.clip(_HALVED * radius / step, *_CLIPPED)
    reach = min(count, _BEYOND)
    if line.closed:
        before, after = np.arange(count - reach, count), np.arange(1, reach + 1)
        ends = unit[before], unit[after]
    else:
        before, after = np.arange(reach, 0, -1), np.arange(count - 1, count - reach - 1, -1)
        ends = 2.0 * unit[0] - unit[before], 2.0 * unit[-1] - unit[after]
    table = np.concatenate((ends[0], unit, ends[1]))
    return share, table, np.concatenate((steps[before], steps, steps[after]))


def _shorter(line: Course, places: Floats, count: int) -> Floats:
    """Return the places between the ends of a line, (count, 3)."""
    reach = (len(places) - count) // 2
    between = places[reach : reach + count] + line.points[0]
    if line.closed:
        between[-1] = between[0]
    else:
        between[[0, -1]] = line.points[[0, -1]]
    return between


def marks_of(points: Floats) -> Floats:
    """Return the length of a line before each of its points, (n,)."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate(([0.0], np.cumsum(steps)))


def mean_along(marks: Floats, values: Floats) -> float:
    """Return the mean of values at the points of a line, with even weight for even lengths."""
    steps = np.diff(marks)
    return float((steps * (values[1:] + values[:-1])).sum() / (2.0 * marks[-1]))


def even_places(marks: Floats, points: Floats, radius: Floats) -> tuple[Floats, Floats]:
    """Return shares of the length of a line in even steps, (n,), and places and radii there, (n, 4)."""
    length = float(marks[-1])
    mean = max(mean_along(marks, radius), length / _MOST)
    count = int(np.clip(_PER_RADIUS * length / mean, _LEAST, _MOST))
    share = np.linspace(0.0, 1.0, count + 1)
    return share, at_marks(share * length, marks, np.column_stack((points, radius)))


def at_marks(wanted: Floats, marks: Floats, table: Floats) -> Floats:
    """Return the columns of a table, (n, k), of values at some marks, in between at other marks."""
    return np.column_stack([np.interp(wanted, marks, column) for column in table.T])


def _bends(points: Floats, step: float) -> tuple[Floats, Floats, Floats]:
    """Return unit tangents, curvatures and torsions by differences; two places at each end have those of the third."""
    a, b, c, d, e = (points[i : len(points) - 4 + i] for i in range(5))
    first = (a - e + 8.0 * (d - b)) / (12.0 * step)
    second = (16.0 * (b + d) - a - e - 30.0 * c) / (12.0 * step * step)
    third = (e - a + 2.0 * (b - d)) / (2.0 * step * step * step)
    across = np.cross(first, second)
    speed, turn = np.linalg.norm(first, axis=1), dot(across, across)
    tiny = float(np.finfo(float).tiny)
    curvature = np.sqrt(turn) / np.maximum(speed * speed * speed, tiny)
    torsion = dot(across, third) / np.maximum(turn, tiny)
    row = np.clip(np.arange(len(points)) - _AROUND, 0, len(c) - 1)
    return (first / np.maximum(speed, tiny)[:, None])[row], curvature[row], torsion[row]
