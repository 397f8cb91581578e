# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines are smoothed as far as their balls allow, and their bends are measured.

The centre line of a solid bends no sharper than its balls, so waves much shorter than the circumference of a ball are
noise of the points. The smooth line is the one with the least sum of squares of deviations and of weighted fourth
differences (Whittaker 1923). A wave that is 0.7 circumferences long loses half its height, and
one twice as long 0.4 %.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..small_matrices import dot

if TYPE_CHECKING:
    from numpy.typing import NDArray

_PER_RADIUS = 8  # a mean radius has so many steps
_LEAST, _MOST = 16, 16_384  # a line has so many
_HALVED = 0.7  # waves of so many circumferences lose half their height
_CLIPPED = 2.0, 16.0  # that many radii count as so many steps
_BEYOND = 64  # so many steps beyond an end have an influence
_FOURTH = 1.0, -4.0, 6.0, -4.0, 1.0
_BAND = len(_FOURTH)
_AROUND = 2  # so many places before and after a place decide how the line bends there


@dataclass(frozen=True, eq=False)
class SmoothLine:
    """A smooth line has places in even steps, from its start to its end.

    Parameters
    ----------
    share : (n,) float64
        The share of the length of the given line before each place, from 0 to 1.
    points : (n, 3) float64
        The ends may be off those of the given line.
    radius : (n,) float64
    tangent : (n, 3) float64
        Unit vectors.
    length : float
        The length of the smooth line.
    curvature : (n,) float64
        In the inverse of the unit of lengths.
    torsion : (n,) float64
        As curvature; it is positive if the line turns like the thread of a usual screw, and means nothing where the
        curvature is close to 0.
    """

    share: NDArray[np.float64]
    points: NDArray[np.float64]
    radius: NDArray[np.float64]
    tangent: NDArray[np.float64]
    length: float
    curvature: NDArray[np.float64]
    torsion: NDArray[np.float64]


def smooth_line(
    points: NDArray[np.float64], radius: NDArray[np.float64], closed: bool
) -> SmoothLine | None:
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
    smooth = smoothed(unit, steps[row])
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


def smooth_between(
    points: NDArray[np.float64], radius: NDArray[np.float64], closed: bool
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return shares and places of a smooth line in even steps, whose ends are those of the given line.

    Beyond each end the line goes on as its own image in the end, so the end stays and its direction is free.

    Parameters
    ----------
    points, radius, closed
        As of `smooth_line`; the line has a length.

    Returns
    -------
    share : (n,) float64
        As of `SmoothLine`.
    places : (n, 3) float64
        The last place of a closed line is its first; it may be off the given line, as all others.
    """
    marks = marks_of(points)
    length = float(marks[-1])
    share, places = even_places(marks, points, radius)
    count = len(share) - 1
    steps = np.clip(_HALVED * places[:, 3] * (count / length), *_CLIPPED)
    unit = (places[:, :3] - points[0]) / length
    reach = min(count, _BEYOND)
    if closed:
        before, after = np.arange(count - reach, count), np.arange(1, reach + 1)
        ends = unit[before], unit[after]
    else:
        before, after = np.arange(reach, 0, -1), np.arange(count - 1, count - reach - 1, -1)
        ends = 2.0 * unit[0] - unit[before], 2.0 * unit[-1] - unit[after]
    table = np.concatenate((ends[0], unit, ends[1]))
    smooth = smoothed(table, np.concatenate((steps[before], steps, steps[after])))
    smooth = smooth[reach : reach + count + 1]
    if closed:
        smooth[-1] = smooth[0]
    else:
        smooth[[0, -1]] = unit[[0, -1]]
    return share, smooth * length + points[0]


def marks_of(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the length of a line before each of its points, (n,)."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return np.concatenate(([0.0], np.cumsum(steps)))


def mean_along(marks: NDArray[np.float64], values: NDArray[np.float64]) -> float:
    """Return the mean of values at the points of a line, with even weight for even lengths."""
    steps = np.diff(marks)
    return float((steps * (values[1:] + values[:-1])).sum() / (2.0 * marks[-1]))


def even_places(
    marks: NDArray[np.float64], points: NDArray[np.float64], radius: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return shares of the length of a line in even steps, (n,), and places and radii there, (n, 4)."""
    length = float(marks[-1])
    mean = max(mean_along(marks, radius), length / _MOST)
    count = int(np.clip(_PER_RADIUS * length / mean, _LEAST, _MOST))
    share = np.linspace(0.0, 1.0, count + 1)
    return share, at_marks(share * length, marks, np.column_stack((points, radius)))


def at_marks(
    wanted: NDArray[np.float64], marks: NDArray[np.float64], table: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the columns of a table, (n, k), of values at some marks, in between at other marks."""
    return np.column_stack([np.interp(wanted, marks, column) for column in table.T])


def smoothed(places: NDArray[np.float64], steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return smooth places, (n, 3), for at least 5 places in even steps.

    Parameters
    ----------
    places : (n, 3) float64
    steps : (n,) float64
        Waves of 2 pi times so many steps lose half their height.
    """
    middle = steps[2:-2]
    square = middle * middle
    weight = square * square * square * square
    count = len(places)
    bands = np.zeros((_BAND, count))
    bands[0] = 1.0
    for i, a in enumerate(_FOURTH):
        for j, b in enumerate(_FOURTH[i:]):
            bands[j, i : i + len(weight)] += a * b * weight
    return _solved(bands.T.tolist(), places)


def _solved(bands: list[list[float]], wanted: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what a symmetric band matrix turns into the wanted table, (n, 3), by Cholesky's method without roots.

    Row j of `bands` has the entries (j, j), (j + 1, j), and so on; those beyond the matrix are 0. NumPy has no such
    method, and products of small lists are faster in plain Python.
    """
    size, reach = len(bands), _BAND - 1
    pivots: list[float] = []
    below: list[list[float]] = []  # row j has the factors (j + 1, j), (j + 2, j), ...
    columns = [column.tolist() for column in wanted.T]
    for j in range(size):
        row = list(bands[j])
        for back in range(1, min(reach, j) + 1):
            factors, pivot = below[j - back], pivots[j - back]
            first = factors[back - 1] * pivot
            for k in range(_BAND - back):
                row[k] -= first * factors[back - 1 + k]
            for column in columns:
                column[j] -= factors[back - 1] * column[j - back]
        pivots.append(row[0])
        below.append([value / row[0] for value in row[1:]])
    for column in columns:
        for j in range(size - 1, -1, -1):
            value = column[j] / pivots[j]
            for k in range(1, min(reach, size - 1 - j) + 1):
                value -= below[j][k - 1] * column[j + k]
            column[j] = value
    return np.array(columns).T


def _bends(
    points: NDArray[np.float64], step: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
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
