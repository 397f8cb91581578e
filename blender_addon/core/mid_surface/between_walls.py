# SPDX-License-Identifier: GPL-3.0-or-later
"""The middle between the two walls of a sheet, and how far these are apart, by rays from places inside of the solid.

At its rims a sheet goes on as it does farther inside. That is right where its thickness changes evenly. Elsewhere a
vertex of the axis at a rim tells it better: it is inside of the solid, so rays from there along the normal of the sheet
meet both of its walls.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats
from ..machine.native import own_errors
from .sheet_walls import Walls

_REACH = 2.0  # so many radii away both walls are looked for; they are two apart at most; derived: two radii, and none
_LIKE = 0.25  # in radii: walls whose distance differs by more from the expected one are others; chosen: unseen


def between_walls(
    places: Floats, normals: Floats, radius: Floats, expected: Floats, walls: Walls
) -> tuple[Flags, Floats, Floats]:
    """Measure a sheet between its walls, from (n, 3) places inside of the solid along its (n, 3) unit normals.

    `radius` (n,) is half of its thickness somewhere near, and `expected` (n,) about that half there. Returns (n,)
    whether both walls are about where they are expected, (n, 3) the middles and (n,) half of the way between the walls;
    elsewhere these are nothing.
    """
    with own_errors() as module:
        below, above = (
            np.asarray(
                module.wall_distances(
                    np.ascontiguousarray(places),
                    np.ascontiguousarray(side * normals),
                    (_REACH + _LIKE) * radius,
                    walls.points,
                    walls.triangles,
                )
            )
            for side in (1.0, -1.0)
        )
    found = np.isfinite(below) & np.isfinite(above)
    below, above = (np.where(found, each, 0.0) for each in (below, above))
    half = 0.5 * (below + above)
    found &= np.abs(half - expected) <= _LIKE * radius
    return found, places + 0.5 * (above - below)[:, None] * normals, half
