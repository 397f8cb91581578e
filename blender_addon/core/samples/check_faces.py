# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that a shape has faces that can be sampled."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..errors import DegenerateInputError, InvalidInputError
from ..settings import SamplingMode
from ..small_matrices import dot, stretches

if TYPE_CHECKING:
    from .shape import Shape

_ROUNDINGS = 4  # a surface thinner than this number of roundings to float32, in which meshes are stored, is flat


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
    """Raise DegenerateInputError when all faces lie in a plane, up to the rounding of their corners to float32."""
    corners = shape.points[np.unique(shape.triangles)]
    around = corners - corners.mean(axis=0)
    columns = np.ascontiguousarray(around.T)
    _, axes, _ = stretches(np.array([[dot(p, q) for q in columns] for p in columns]))
    thickness = float(np.ptp(dot(around, axes[2])))
    if thickness <= _ROUNDINGS * float(np.finfo(np.float32).eps) * float(np.abs(corners).max()):
        raise DegenerateInputError(
            "Expected faces that span a volume, found all of them in one plane; give them "
            "thickness (a Solidify modifier, or an extrusion)"
        )
