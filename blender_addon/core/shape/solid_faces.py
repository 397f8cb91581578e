# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces on which analysed samples lie, from which a hierarchy takes crisp places (docs/stage_crisp.md)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Ints
from ..settings import Settings, SidesFrom
from .shape import Shape

# Edges are sharp from this multiple of the angle on: tubes of twelve sides are round, and bent ones have 30.1 degrees.
_CLEARLY = 1.01  # measured: 30.1 of 30 degrees


@dataclass(frozen=True, eq=False)
class SolidFaces:
    """The faces that bound the solid, and where the samples lie on them."""

    shape: Shape
    # (n,) The triangle of the shape on which each sample lies; -1 for a sample that closes an opening
    face: Ints
    # The samples lie on the flat faces, whatever the settings say, with edges that are sharp from this angle on; 0.0:
    # as the settings say
    flat: float = 0.0

    def options(self, settings: Settings) -> tuple[float, bool]:
        """Return the sharp angle and whether the faces approximate a smooth surface."""
        return self.flat or sharp_angle_of(self.shape, settings), settings.smooth and not self.flat

    def of_module(self, module: Any, sharp_angle: float, smooth: bool) -> Any:
        """Return the `_medial.Faces`, with `options`."""
        shape = self.shape
        return module.Faces(
            shape.points,
            shape.triangles,
            self.face,
            sharp_angle=sharp_angle,
            sharp_edges=shape.sharp_edges,
            smooth=smooth,
        )


def solid_faces(
    shape: Shape, source: SidesFrom, face: Ints | None = None, flat: float = 0.0
) -> SolidFaces | None:
    """Return the faces of a shape if they decide what is inside, and None otherwise.

    The (n,) faces are the triangles on which samples lie, by default a triangle at each vertex; `flat` is as in
    `SolidFaces`.
    """
    if source is not SidesFrom.SURFACE or not len(shape.triangles) or not shape.volume > 0:
        return None
    return SolidFaces(shape, _face_of_vertex(shape) if face is None else face, flat)


def sharp_angle_of(shape: Shape, settings: Settings) -> float:
    """Return the angle in radians from which edges of the shape are sharp."""
    wider = 2.0 if shape.shaded_smooth else _CLEARLY
    return min(wider * settings.sharp_angle, math.pi)


def _face_of_vertex(shape: Shape) -> Ints:
    """Return the first triangle at each vertex, (n,), or -1."""
    face = np.full(len(shape.points), -1, np.int32)
    kept = np.flatnonzero(~shape.left_out).astype(np.int32)
    rows = np.repeat(kept, 3)
    face[shape.triangles[kept].ravel()[::-1]] = rows[::-1]  # the last assignment counts
    return face
