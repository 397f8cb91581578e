# SPDX-License-Identifier: GPL-3.0-or-later
"""The measured thickness of a shape, before a limit decides which parts are thin."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..machine import native
from ..samples.surface_normals import cross
from ..settings import Between, ThicknessSettings
from .thin_faces import face_of_triangles, thinnest_of_faces

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..samples.chosen import ChosenSamples
    from ..samples.shape import Shape

# Coordinates may once have been float32, as all of Blender's are: lengths that differ by less are equal.
_ROUNDING = 4 * float(np.finfo(np.float32).eps)


@dataclass(frozen=True, eq=False)
class Measurement:
    """A measured shape; which limit makes it thin is asked later.

    Parameters
    ----------
    shape : Shape
    chosen : ChosenSamples
    settings : ThicknessSettings
        What was measured; its limit is not used here.
    triangles : (f, 3) int32
        The measured surface, rows of the samples.
    lengths : (n,) float64
        At each sample; infinite where there is no wall.
    measured : (n,) bool
        At the sample itself; else filled from the nearest, or infinite.
    at_edge : (n,) bool
        On a sharp edge.
    normals : str
        Where the normals come from, a sentence.
    noise : float
        Standard deviation of the samples in spacings, 0 to 0.25.
    warnings : tuple of str
    seconds : float
    key : str
        Names the measurement for `kept_measurement`.
    """

    shape: Shape
    chosen: ChosenSamples
    settings: ThicknessSettings
    triangles: NDArray[np.int32]
    lengths: NDArray[np.float64]
    measured: NDArray[np.bool_]
    at_edge: NDArray[np.bool_]
    normals: str
    noise: float
    warnings: tuple[str, ...]
    seconds: float
    key: str = ""

    @property
    def points(self) -> NDArray[np.float64]:
        """(n, 3) the samples."""
        return self.chosen.samples.points

    @cached_property
    def of_triangles(self) -> NDArray[np.float64]:
        """(f,) the median of the corners, so that no single sample decides; and no less than the others where one or
        two of them are on an edge, which belongs to two sides."""
        values, on_edge = self.lengths[self.triangles].T, self.at_edge[self.triangles].T
        a, b, c = values
        median = np.maximum(np.minimum(a, b), np.minimum(np.maximum(a, b), c))
        mixed = on_edge.any(axis=0)
        others = np.where(on_edge[:, mixed], -np.inf, values[:, mixed]).max(axis=0)
        median[mixed] = np.maximum(median[mixed], others)
        if self.settings.between is Between.GAP:  # the corner of a solid is in front of nothing
            median[on_edge.all(axis=0)] = np.inf
        return median

    @cached_property
    def areas(self) -> NDArray[np.float64]:
        """(f,) of the triangles."""
        a, b, c = (self.points[self.triangles[:, corner]] for corner in range(3))
        return np.linalg.norm(cross(b - a, c - a), axis=1) / 2

    @cached_property
    def minimum(self) -> float:
        """The least of all triangles; infinite where there is nothing."""
        return float(self.of_triangles.min(initial=np.inf))

    @cached_property
    def slack(self) -> float:
        """How much a length has to lie below a limit to be shorter: the rounding of the coordinates."""
        return _ROUNDING * float(np.abs(self.points).max(initial=0.0))

    @cached_property
    def of_vertices(self) -> NDArray[np.float64]:
        """(v,) at each vertex of the shape: that of the nearest sample."""
        if len(self.points) == len(self.shape.points) and self.chosen.samples.kinds is None:
            return self.lengths
        with native.own_errors() as module:
            return self.lengths[module.nearest(self.points, self.shape.points)]

    @cached_property
    def triangle_of_faces(self) -> NDArray[np.int32]:
        """(m,) the triangle that speaks for each face of the shape, the thinnest in it; -1: none."""
        samples = self.chosen.samples
        if self.triangles is self.shape.triangles:
            return np.arange(len(self.triangles), dtype=np.int32)
        inside = face_of_triangles(self.triangles, self.at_edge, samples.faces)
        return thinnest_of_faces(
            self.shape, self.points, self.triangles, self.of_triangles, self.at_edge, inside
        )

    @property
    def bytes(self) -> int:
        arrays: tuple[NDArray, ...] = (
            self.triangles,
            self.lengths,
            self.measured,
            self.points,
            self.shape.points,
        )
        return sum(x.nbytes for x in arrays) + 40 * len(self.triangles)
