# SPDX-License-Identifier: GPL-3.0-or-later
"""Points lose accuracy in Blender's 32 bits, for example scans with the coordinates of a national grid."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_NOTICED = 0.05  # this share of the spacing is noticed; noise may be up to a third of the spacing
_SAMPLE = 16  # the spacing is measured at so many points


def rounding_warning(points: NDArray[np.float64]) -> str | None:
    """Return a warning if float32 moves points by a noticeable share of their spacing, otherwise None.

    Parameters
    ----------
    points : (n, 3) float64
        They must be below the largest float32.
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
    """Return the median distance of a few points to the nearest other place; it is infinite if there is none."""
    rows = np.linspace(0, len(points) - 1, min(_SAMPLE, len(points))).astype(np.int64)
    axes = np.ascontiguousarray(points.T)  # this is much faster than row by row
    nearest = []
    for row in rows:
        distances = np.abs(axes - axes[:, [row]]).max(axis=0)  # squares might overflow
        nearest.append(distances[distances > 0.0].min(initial=np.inf))
    return float(np.median(nearest))
