# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of a solid as the walls at which its sheets end, and its reflex edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..machine.native import own_errors

TOUCHES = 0.01  # of its radius: a ball whose distance from an edge differs by less touches it; chosen: unseen
_REACH = 2.0  # so many radii away both walls are looked for; they are two apart at most; derived: two radii, and none
_LIKE = 0.25  # in radii: walls whose distance differs by more from the expected one are others; chosen: unseen


@dataclass(frozen=True, eq=False)
class Walls:
    """The faces of a solid, outward, and the rows of the ends of its reflex edges, (e, 2)."""

    points: Floats
    triangles: Ints
    reflex: Ints


def reflex_distances(points: Floats, walls: Walls) -> Floats:
    """(n,) how far points are from the nearest reflex edge; infinite where the solid has none."""
    if not len(walls.reflex) or not len(points):
        return np.full(len(points), np.inf)
    edges = np.ascontiguousarray(walls.reflex[:, [0, 1, 1]].astype(np.int32))
    with own_errors() as module:
        return np.asarray(module.TriangleTree(walls.points, edges).distances(points))


def between_walls(
    places: Floats, normals: Floats, radius: Floats, expected: Floats, walls: Walls
) -> tuple[Flags, Floats, Floats]:
    """Measure a sheet between its walls, from (n, 3) places inside of the solid along its (n, 3) unit normals.

    At its rims a sheet goes on as it does farther inside. That is right where its thickness changes evenly. Elsewhere a
    vertex of the axis at a rim tells it better: it is inside of the solid, so these rays meet both walls.

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
