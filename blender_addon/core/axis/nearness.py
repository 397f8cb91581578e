# SPDX-License-Identifier: GPL-3.0-or-later
"""Which points lie near others, or in one place. NumPy has no search tree, and Blender's Python need not have SciPy."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def same_place(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """(n,) a number for each of (n, 3) points, the same where the coordinates are; from 0 upwards."""
    _, place = np.unique(points + 0.0, axis=0, return_inverse=True)  # -0.0 is 0.0
    return place.reshape(-1).astype(np.int64)


def near(
    points: NDArray[np.float64], others: NDArray[np.float64], reach: float
) -> NDArray[np.bool_]:
    """Whether one of the others is at most `reach` away, by a grid; quick where few of them are near each point.

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
    lowest, highest = others.min(axis=0), others.max(axis=0)
    size = np.floor((highest - lowest) / reach).astype(np.int64) + 5  # two cells of rim all round
    cells = _cells(others, lowest, reach, size)
    order = np.argsort(cells, kind="stable")
    others, cells = others[order], cells[order]
    inside = (points >= lowest - reach) & (points <= highest + reach)
    left = np.flatnonzero(inside.all(axis=1))
    home = _cells(points[left], lowest, reach, size)
    for step in product((-1, 0, 1), repeat=3):
        cell = home + np.dot(step, _strides(size))
        first, last = np.searchsorted(cells, cell, "left"), np.searchsorted(cells, cell, "right")
        while len(some := np.flatnonzero(first < last)):
            away = np.linalg.norm(points[left[some]] - others[first[some]], axis=1)
            found[left[some[away <= reach]]] = True
            first[some] += 1
    return found


def _cells(
    points: NDArray[np.float64], lowest: NDArray[np.float64], reach: float, size: NDArray[np.int64]
) -> NDArray[np.int64]:
    place = np.floor((points - lowest) / reach).astype(np.int64) + 2
    return place @ _strides(size)


def _strides(size: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.array([size[1] * size[2], size[2], 1])
