# SPDX-License-Identifier: GPL-3.0-or-later
"""The distance within which points have to be merged so that few are left."""

from __future__ import annotations

import numpy as np

from ...core.arrays import Floats

_HALVINGS = 16


def merging_distance(points: Floats, most: int) -> float:
    """Return the distance that leaves about `most` of (n, 3) points; 0 where there are no more.

    This many cells of a grid of that width have points in them.
    """
    if len(points) <= most:
        return 0.0
    low, high = 0.0, float(np.ptp(points, axis=0).max())
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        few = _cells(points, middle) <= most
        low, high = (low, middle) if few else (middle, high)
    return high


def _cells(points: Floats, width: float) -> int:
    cells = ((points - points.min(axis=0)) / width).astype(np.int64)
    sizes = cells.max(axis=0) + 1
    return len(np.unique((cells[:, 0] * sizes[1] + cells[:, 1]) * sizes[2] + cells[:, 2]))
