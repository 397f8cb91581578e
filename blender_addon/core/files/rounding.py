# SPDX-License-Identifier: GPL-3.0-or-later
"""Points lose accuracy in 32 bits, for example scans with the coordinates of a national grid.

Blender has no more bits, nor has `.stl`.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..errors import ExportError

_NOTICED = 0.05  # this share of the spacing is noticed; noise may be up to a third of the spacing
_SAMPLE = 16  # the spacing is measured at this many points


def rounding_warning(points: Floats) -> str | None:
    """Return a warning if float32 moves points by a noticeable share of their spacing, otherwise None.

    Parameters
    ----------
    points : (n, 3) float64
        They must be below the largest float32.
    """
    moved = _moved(points)
    if moved == 0.0:
        return None
    spacing = _spacing(points)
    if moved <= _NOTICED * spacing:
        return None
    return (
        f"Blender keeps coordinates in 32 bits, which moves these points by up to {moved:.2g} while "
        f"neighbours lie {spacing:.2g} apart; subtract a common offset from the coordinates in the file"
    )


def check_stl(points: Floats, frame: Floats | None, length: float) -> None:
    """Check that the 32 bits of `.stl` move no point by a noticeable share of what the result is about.

    Parameters
    ----------
    points : (n, 3) float64
        They are in the world.
    frame : (4, 4) float64, optional
        From the units of `length` to the world.
    length : float
        The wall, or what else the points have to show.
    """
    least = 1.0 if frame is None else float(np.sqrt((frame[:3, :3] ** 2).sum(axis=0)).min())
    moved = _moved(points)
    if moved > _NOTICED * length * least:
        raise ExportError(
            f"Expected coordinates that fit the 32 bits of .stl, found some that these move by {moved:.2g} where "
            f"{length * least:.2g} has to show; choose another format, or move the solid nearer to the origin"
        )


def _moved(points: Floats) -> float:
    """Return how far 32 bits move a coordinate at most; it is infinite where one is too large for them."""
    with np.errstate(over="ignore"):
        return float(np.abs(points - points.astype(np.float32)).max(initial=0.0))


def _spacing(points: Floats) -> float:
    """Return the median distance of a few points to the nearest other place; it is infinite if there is none."""
    rows = np.linspace(0, len(points) - 1, min(_SAMPLE, len(points))).astype(np.int64)
    axes = np.ascontiguousarray(points.T)  # this is much faster than row by row
    nearest = []
    for row in rows:
        distances = np.abs(axes - axes[:, [row]]).max(axis=0)  # squares might overflow
        nearest.append(distances[distances > 0.0].min(initial=np.inf))
    return float(np.median(nearest))
