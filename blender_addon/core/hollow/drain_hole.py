# SPDX-License-Identifier: GPL-3.0-or-later
"""The hole through the wall of a hollow solid: the shortest way out of a place of the cavity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..errors import InvalidInputError
from ..machine.native import own_errors
from ..small_matrices import dot, length_of
from .hollow import Hollow

_LEVEL = 0.05  # of the wall: vertices that are less above the lowest are as low; chosen: unseen
_STEP = 1e-3  # of the wall: differences over so much tell the shortest way; derived: rounding
_LONGEST = 4.0  # walls: so far a way out is looked for; chosen: unseen
_PARTS = 256  # of that way
_CLEAR = 0.1  # so much slope at least the distance has where a shortest way is told; chosen: unseen


@dataclass(frozen=True, eq=False)
class DrainHole:
    """A cylinder that opens the wall."""

    # (3,) The middles of its ends, in the cavity and outside
    start: Floats
    end: Floats
    width: float  # Its diameter


def drain_hole(found: Hollow, width: float, down: Floats, near: Floats | None = None) -> DrainHole:
    """Find the hole at the lowest place of the cavity, or at the one nearest to a place.

    Parameters
    ----------
    found : Hollow
    width : float
        The diameter of the hole.
    down : (3,) float64
        The direction in which things fall, of length 1, in the frame of the shape.
    near : (3,) float64, optional
        In the frame of the shape.

    Raises
    ------
    InvalidInputError
        The way out is longer than `_LONGEST` walls.
    NativeModuleError
    """
    row = _lowest(found, down) if near is None else _nearest(found, near)
    place = found.cavity[row]
    way = _way_out(found, place, down)
    steps = np.linspace(0.0, _LONGEST * found.wall, _PARTS + 1)
    along = place + steps[:, None] * way
    with own_errors() as module:
        outer = found.triangles[: found.outer]
        inside = np.asarray(module.winding_number(along, found.shape.points, outer)) > 0.5
    if inside.all():
        raise InvalidInputError(
            f"Expected a way out of less than {_LONGEST:g} walls for the drain hole, found a longer one; place it "
            "with the 3D cursor"
        )
    out = float(steps[int(np.argmin(inside))])
    reach = 0.5 * width + steps[1]
    return DrainHole(place - reach * way, place + (out + reach) * way, width)


def _lowest(found: Hollow, down: Floats) -> int:
    """The vertex in the middle of the lowest ones."""
    depth = dot(found.cavity, down)
    rows = np.flatnonzero(depth >= depth.max() - _LEVEL * found.wall)
    low = found.cavity[rows]
    away = np.linalg.norm(low - low.mean(axis=0), axis=1)
    return int(rows[np.argmin(away)])


def _nearest(found: Hollow, place: Floats) -> int:
    return int(np.argmin(np.linalg.norm(found.cavity - place, axis=1)))


def _way_out(found: Hollow, place: Floats, down: Floats) -> Floats:
    """(3,) the direction in which the distance from the faces falls fastest; down where none is the fastest."""
    step = _STEP * found.wall
    sides = np.concatenate((np.identity(3), -np.identity(3))) * step
    with own_errors() as module:
        distances = np.asarray(
            module.TriangleTree(found.shape.points, found.triangles[: found.outer]).distances(
                place + sides
            )
        )
    way = (distances[3:] - distances[:3]) / (2.0 * step)
    length = length_of(way)
    return way / length if length > _CLEAR else down
