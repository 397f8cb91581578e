# SPDX-License-Identifier: GPL-3.0-or-later
"""This module measures how far places are from the surface of a solid, which is the radius of the ball that fits."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..samples.analysed import Analysed
from ..shape.nearness import nearest
from ..shape.shape import Shape
from ..shape.triangles import unit_normals
from ..small_matrices import dot, length_of

ASIDE = 1e-5  # a buried face has the solid on both sides, so far away as a share of the diagonal; derived: rounding


class Depth:
    """A depth is the distance from a place to the boundary of a solid, to its faces where they decide what is inside.

    Faces inside of the solid bound nothing, and do not count.

    Parameters
    ----------
    samples : Analysed
    shape : Shape or None
        The faces that decide what is inside; without them the samples are the boundary.
    """

    def __init__(self, samples: Analysed, shape: Shape | None) -> None:
        self._samples = samples.points[samples.analysis.samples]
        self._faces: Any = None
        self._offset = samples.offset
        if shape is not None and len(shape.triangles):
            kept = shape.triangles
            if samples.buried:
                kept = kept[~buried_faces(shape.points, kept)]
            if len(kept):
                with native.own_errors() as module:
                    self._faces = module.TriangleTree(shape.points, kept)

    def __call__(self, places: Floats) -> Floats:
        """Return the distances of (n, 3) places from the boundary, (n,), without a sign."""
        if self._faces is None or not len(places):
            away = places - self._samples[nearest(places, self._samples)]
            found = np.sqrt(dot(away, away))
        else:
            with native.own_errors():
                found = self._faces.distances(places)
        return np.maximum(found - self._offset, 0.0)


def buried_faces(points: Floats, triangles: Ints) -> Flags:
    """Return which triangles have the solid, or nothing of it, on both sides at their centre and near all corners."""
    corners = points[triangles]
    normals, _ = unit_normals(corners)
    middle = corners.mean(axis=1)
    looks = [middle, *(0.1 * middle + 0.9 * corners[:, corner] for corner in range(3))]
    offset = ASIDE * length_of(np.ptp(points, axis=0))
    with native.own_errors() as module:
        found = module.buried(
            np.concatenate(looks), np.tile(normals, (4, 1)), offset, points, triangles
        )
    return found.reshape(4, -1).all(axis=0)
