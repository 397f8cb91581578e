# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons of sheets, and their triangles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Floats, Ints, Longs
from ..axis.polygon_triangles import polygon_triangles

TRIFLE = 1e-3  # of a length or an area: so small a share counts for nothing; chosen: unseen
ROUNDING = 1e-6  # of a length: so small a share is none; derived: rounding


@dataclass(frozen=True, eq=False)
class SheetFaces:
    """The polygons of sheets."""

    vertices: Floats  # (v, 3)
    offsets: Ints  # (f + 1,)
    # (c,) Face i has the corners `corners[offsets[i]:offsets[i + 1]]`. Those of a sheet turn the
    # same way.
    corners: Ints
    part: Ints  # (f,) The sheet of each face

    @cached_property
    def triangles(self) -> Ints:
        """(c - 2 f, 3) those of face after face."""
        return polygon_triangles(self.vertices, self.offsets, self.corners)

    @cached_property
    def of(self) -> Longs:
        """The face of each triangle."""
        return np.repeat(np.arange(len(self.part)), np.diff(self.offsets) - 2)

    def ring(self, face: int) -> Floats:
        """(k, 3) the places round a face."""
        return self.vertices[self.corners[self.offsets[face] : self.offsets[face + 1]]]
