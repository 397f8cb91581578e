# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of a solid as the walls at which its sheets end, and its reflex edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..machine.native import own_errors

TOUCHES = 0.01  # of its radius: a ball whose distance from an edge differs by less touches it; chosen: unseen


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
        return np.asarray(
            module.surface_distances(np.ascontiguousarray(points), walls.points, edges)
        )
