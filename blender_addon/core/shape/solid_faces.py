# SPDX-License-Identifier: GPL-3.0-or-later
"""The faces on which analysed samples lie, from which a hierarchy takes crisp places (docs/stage_crisp.md)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints
from ..settings import Settings, SidesFrom
from .outward_faces import are_left_out
from .shape import Shape
from .sharp_angle import sharp_angle_of


@dataclass(frozen=True, eq=False)
class SolidFaces:
    """The faces that bound the solid, and where the samples lie on them.

    Parameters
    ----------
    shape : Shape
    face : (n,) int32
        The triangle of the shape on which each sample lies; -1 for a sample that closes an opening.
    flat : bool
        The samples lie on the flat faces, whatever the settings say.
    """

    shape: Shape
    face: Ints
    flat: bool = False

    @property
    def arrays(self) -> tuple[NDArray[Any], ...]:
        """The arrays that these faces keep in memory."""
        return self.shape.points, self.shape.triangles, self.face

    def options(self, settings: Settings) -> tuple[float, bool]:
        """Return the sharp angle and whether the faces approximate a smooth surface."""
        return sharp_angle_of(self.shape, settings), settings.smooth and not self.flat

    def of_module(self, module: Any, settings: Settings) -> Any:
        """Return the `_medial.Faces`."""
        sharp_angle, smooth = self.options(settings)
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
    shape: Shape, source: SidesFrom, face: Ints | None = None, flat: bool = False
) -> SolidFaces | None:
    """Return the faces of a shape if they decide what is inside, and None otherwise.

    Parameters
    ----------
    shape : Shape
    source : SidesFrom
    face : (n,) int32, optional
        The triangle on which each sample lies; the default is a triangle at each vertex.
    flat : bool
        As in `SolidFaces`.
    """
    if source is not SidesFrom.SURFACE or not len(shape.triangles) or not shape.volume > 0:
        return None
    return SolidFaces(shape, _face_of_vertex(shape) if face is None else face, flat)


def triangles_of_places(shape: Shape, settings: Settings) -> int:
    """Return how many triangles may give crisp places, for the forecast of memory; 0 if there are no such places."""
    return len(shape.triangles) if settings.crisp and settings.crisp_is_possible else 0


def _face_of_vertex(shape: Shape) -> Ints:
    """Return the first triangle at each vertex, (n,), or -1."""
    face = np.full(len(shape.points), -1, np.int32)
    kept = np.flatnonzero(~are_left_out(shape)).astype(np.int32)
    rows = np.repeat(kept, 3)
    face[shape.triangles[kept].ravel()[::-1]] = rows[::-1]  # the last assignment counts
    return face
