# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces of a solid that no sheet of its middle surface stands for: they are farther from all sheets than walls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from ..machine.native import own_errors
from ..shape.shape import Shape
from ..shape.triangle_faces import TriangleFaces
from .sheet_faces import SheetFaces

_BESIDE = 0.6  # thicknesses from a sheet its walls lie at most; half of one where it is straight; derived: above 1 / 2
_STEPS = 6  # of a grid of places on each triangle

Lengths = Callable[["Floats", "Ints"], "Floats"]


@dataclass(frozen=True, eq=False)
class ThickFaces(TriangleFaces):
    """Triangles as a mesh."""

    vertices: Floats  # (v, 3)
    triangles: Ints  # (t, 3)


def thick_faces(shape: Shape, sheets: SheetFaces, lengths: Lengths) -> ThickFaces:
    """Return the triangles of a solid of which more than half is farther from all sheets than their walls are.

    Parameters
    ----------
    shape : Shape
    sheets : SheetFaces
    lengths : function
        Of (n, 3) places and their (n,) sheets: (n,) the thickness there.
    """
    grid = _grid()
    corners = shape.points[shape.triangles]
    places = np.ascontiguousarray((grid[None, :, :, None] * corners[:, None]).sum(axis=2))
    places = places.reshape(-1, 3)
    beside = np.zeros(len(places), bool)
    for sheet in np.unique(sheets.part):
        mine = np.ascontiguousarray(sheets.triangles[sheets.part[sheets.of] == sheet])
        rows = np.flatnonzero(~beside)
        thickness = lengths(places[rows], np.full(len(rows), sheet, np.int32))
        with own_errors() as module:
            away = np.asarray(module.TriangleTree(sheets.vertices, mine).distances(places[rows]))
        beside[rows[away <= _BESIDE * thickness]] = True
    share = beside.reshape(len(corners), -1).mean(axis=1)
    used, row = np.unique(shape.triangles[share < 0.5], return_inverse=True)
    return ThickFaces(shape.points[used], row.reshape(-1, 3).astype(np.int32))


def _grid() -> Floats:
    """(k, 3) weights of the corners at the middles of the cells of a triangle that is cut evenly."""
    first, second = np.indices((_STEPS, _STEPS)).reshape(2, -1)
    inside = first + second < _STEPS
    one, two = (first[inside] + 1 / 3) / _STEPS, (second[inside] + 1 / 3) / _STEPS
    return np.column_stack((one, two, 1.0 - one - two))
