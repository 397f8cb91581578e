# SPDX-License-Identifier: GPL-3.0-or-later
"""Chains are simplified by the rule of Douglas and Peucker (1973), with a tolerance for each point."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Longs
from ..small_matrices import dot


def kept_points(points: Floats, tolerance: Floats) -> Longs:
    """Return the points of a chain that are kept, ascending.

    They include its ends, and no other point is farther than its tolerance from the chain of the kept points.

    Parameters
    ----------
    points : (n, k) float64
        The dimension k is arbitrary. The first and last points of a closed chain are equal.
    tolerance : (n,) float64
    """
    last = len(points) - 1
    kept, left = {0, last}, [(0, last)]
    while left:
        first, end = left.pop()
        if end - first < 2:
            continue
        inner = slice(first + 1, end)
        excess = _distance(points[inner], points[first], points[end]) / tolerance[inner]
        worst = int(np.argmax(excess))
        if excess[worst] > 1.0:
            kept.add(first + 1 + worst)
            left += [(first, first + 1 + worst), (first + 1 + worst, end)]
    if last > 2 and np.array_equal(points[0], points[last]) and len(kept) < 4:
        kept |= {last // 3, 2 * last // 3}  # a loop must not collapse to a line
    return np.array(sorted(kept), np.int64)


def _distance(points: Floats, a: Floats, b: Floats) -> Floats:
    """Return the distances from points to a segment."""
    along = b - a
    square = float(dot(along, along))
    share = (
        np.clip(dot(points - a, along) / square, 0.0, 1.0)
        if square > 0.0
        else np.zeros(len(points))
    )
    return np.linalg.norm(points - a - share[:, None] * along, axis=1)
