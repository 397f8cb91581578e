# SPDX-License-Identifier: GPL-3.0-or-later
"""Searches among points: points near others, points in the same place, and the nearest of others.

NumPy has no search tree, and Blender's Python does not always have SciPy.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs

# The smallest cell, in a unit in which no coordinate is larger than 1: numbers of smaller cells overflow 64 bits.
_SMALLEST_CELL = 2.0**-60  # derived: above the rounding of ids in cells


def same_place(points: Floats) -> Longs:
    """(n,) a number from 0 upwards for each of (n, 3) points; points with the same coordinates get the same number."""
    _, place = np.unique(points + 0.0, axis=0, return_inverse=True)  # -0.0 is 0.0
    return place.reshape(-1).astype(np.int64)


def sample_of_row(points: Floats, samples: Ints) -> Longs:
    """Return the number of the sample that each row is, (n,).

    The module merges rows that differ by next to nothing, too, so a row may equal no sample: it is the nearest one.

    Parameters
    ----------
    points : (n, 3) float64
    samples : (k,) int32
        The first row of each distinct point, as `_medial.MedialAnalysis.samples` has them.
    """
    if len(samples) == len(points):
        return np.arange(len(points))
    which = same_place(points)
    place = np.full(which.max() + 1, -1, np.int64)
    place[which[samples]] = np.arange(len(samples))
    found = place[which]
    merged = np.flatnonzero(found < 0)
    found[merged] = nearest(points[merged], points[samples])
    return found


def near(points: Floats, others: Floats, reach: float) -> Flags:
    """Test by a grid whether one of the others is at most `reach` away; quick where few of them are near each point.

    Parameters
    ----------
    points : (n, 3) float64
    others : (m, 3) float64
    reach : float

    Returns
    -------
    near : (n,) bool
    """
    found = np.zeros(len(points), bool)
    if not len(others) or not reach > 0.0:
        return found
    points, others, reaches = _in_unit(points, others, np.array(reach))
    reach = float(reaches)
    cell_size = max(reach, _SMALLEST_CELL)
    lowest, highest = others.min(axis=0), others.max(axis=0)
    size = (
        np.floor((highest - lowest) / cell_size).astype(np.int64) + 5
    )  # two cells of rim all round
    cells = _cells(others, lowest, cell_size, size)
    order = np.argsort(cells, kind="stable")
    others, cells = others[order], cells[order]
    inside = (points >= lowest - reach) & (points <= highest + reach)
    left = np.flatnonzero(inside.all(axis=1))
    home = _cells(points[left], lowest, cell_size, size)
    for step in product((-1, 0, 1), repeat=2):  # three cells in a row have consecutive numbers
        cell = home + np.dot((*step, 0), _strides(size))
        first = np.searchsorted(cells, cell - 1, "left")
        last = np.searchsorted(cells, cell + 1, "right")
        while len(some := np.flatnonzero(first < last)):
            away = np.linalg.norm(points[left[some]] - others[first[some]], axis=1)
            hit = away <= reach
            found[left[some[hit]]] = True
            first[some] = np.where(hit, last[some], first[some] + 1)  # one hit is enough
        more = ~found[left]
        left, home = left[more], home[more]
    return found


def nearest(points: Floats, others: Floats) -> Longs:
    """Find the nearest of others to each point, by grids that grow coarser where they find nothing.

    Parameters
    ----------
    points : (n, 3) float64
    others : (m, 3) float64
        At least one point.

    Returns
    -------
    nearest : (n,) int64
        Rows of `others`; the lower row of two equally near ones.
    """
    found, left = np.zeros(len(points), np.int64), np.arange(len(points))
    points, others = _in_unit(points, others)
    size = np.ptp(np.concatenate((points, others)), axis=0)
    reach = max(float(size.max()) / np.sqrt(len(others)), np.finfo(float).tiny)
    while len(left):
        row, away = _nearest_in_cells(points[left], others, reach)
        sure = away <= reach  # no point in a farther cell can be nearer
        found[left[sure]] = row[sure]
        left, reach = left[~sure], 2.0 * reach
    return found


def _in_unit(*lengths: Floats) -> tuple[Floats, ...]:
    """Scale lengths by a power of two, which is exact, so that none is larger than 1 and no square overflows."""
    largest = max(float(np.abs(some).max(initial=0.0)) for some in lengths)
    return tuple(np.ldexp(some, -int(np.frexp(largest)[1])) for some in lengths)


def _nearest_in_cells(points: Floats, others: Floats, reach: float) -> tuple[Longs, Floats]:
    """Find the nearest of those in the cells round each point, and its distance; infinite where there is none."""
    lowest = np.minimum(points.min(axis=0), others.min(axis=0))
    highest = np.maximum(points.max(axis=0), others.max(axis=0))
    size = np.floor((highest - lowest) / reach).astype(np.int64) + 5
    cells = _cells(others, lowest, reach, size)
    order = np.argsort(cells, kind="stable")
    sorted_cells, home = cells[order], _cells(points, lowest, reach, size)
    row, away = np.zeros(len(points), np.int64), np.full(len(points), np.inf)
    for step in product((-1, 0, 1), repeat=3):
        cell = home + np.dot(step, _strides(size))
        first = np.searchsorted(sorted_cells, cell, "left")
        last = np.searchsorted(sorted_cells, cell, "right")
        while len(some := np.flatnonzero(first < last)):
            other = order[first[some]]
            distance = np.linalg.norm(points[some] - others[other], axis=1)
            nearer = (distance < away[some]) | ((distance == away[some]) & (other < row[some]))
            row[some[nearer]], away[some[nearer]] = other[nearer], distance[nearer]
            first[some] += 1
    return row, away


def _cells(points: Floats, lowest: Floats, reach: float, size: Longs) -> Longs:
    place = np.floor((points - lowest) / reach).astype(np.int64) + 2
    return place @ _strides(size)


def _strides(size: Longs) -> Longs:
    """Return the steps between the numbers of neighbouring cells, (3,).

    Very many cells overflow silently: then cells that are far apart may have the same number.
    """
    return np.array([size[1:].prod(), size[2], 1])
