# SPDX-License-Identifier: GPL-3.0-or-later
"""The loss of points that Blender keeps in 32 bits, as of scans with the coordinates of a country."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_NOTICED = 0.05  # of the spacing; well below the third of it that noise may have
_SAMPLE = 16  # points whose neighbours are measured


def rounding_warning(points: NDArray[np.float64]) -> str | None:
    """A sentence when float32 moves points by a share of their spacing that can be noticed.

    Parameters
    ----------
    points : (n, 3) float64
        Below the largest float32.
    """
    moved = float(np.abs(points - points.astype(np.float32)).max(initial=0.0))
    if moved == 0.0:
        return None
    spacing = _spacing(points)
    if moved <= _NOTICED * spacing:
        return None
    return (
        f"Blender keeps coordinates in 32 bits, which moves these points by up to {moved:.2g} while "
        f"neighbours lie {spacing:.2g} apart; subtract a common offset from the coordinates in the file"
    )


def _spacing(points: NDArray[np.float64]) -> float:
    """Median distance to the nearest point elsewhere, of a sample; infinite when there is no other."""
    rows = np.linspace(0, len(points) - 1, min(_SAMPLE, len(points))).astype(np.int64)
    axes = np.ascontiguousarray(points.T)  # much faster than row by row
    nearest = []
    for row in rows:
        distances = np.abs(axes - axes[:, [row]]).max(axis=0)  # squares might overflow
        nearest.append(distances[distances > 0.0].min(initial=np.inf))
    return float(np.median(nearest))
