# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that a shape has faces that can be sampled."""

from __future__ import annotations

import numpy as np

from ..errors import DegenerateInputError, InvalidInputError
from ..settings import SamplingMode
from ..small_matrices import dot, stretches
from .shape import Shape


def check_faces(shape: Shape, wanted: SamplingMode) -> None:
    """Raise InvalidInputError when there are no faces where samples of them are needed."""
    if len(shape.triangles):
        return
    if not shape.of_samples:
        raise InvalidInputError(
            "Expected faces, found only lines; give the object a surface (a curve needs a bevel or "
            "an extrusion), or choose Sampling Vertices"
        )
    if wanted is not SamplingMode.AUTOMATIC:
        raise InvalidInputError(
            f"Expected faces for Sampling {wanted.name.capitalize()}, found points only; "
            "choose Sampling Automatic or Vertices"
        )


def check_not_flat(shape: Shape) -> None:
    """Raise DegenerateInputError when all faces lie in a plane, up to the rounding of their corners."""
    corners = shape.points[np.unique(shape.triangles)]
    around = corners - corners.mean(axis=0)
    columns = np.ascontiguousarray(around.T)
    _, axes, _ = stretches(np.array([[dot(p, q) for q in columns] for p in columns]))
    thickness = float(np.ptp(dot(around, axes[2])))
    if thickness <= shape.rounding:
        raise DegenerateInputError(
            "Expected faces that span a volume, found all of them in one plane; give them "
            "thickness (a Solidify modifier, or an extrusion)"
        )
