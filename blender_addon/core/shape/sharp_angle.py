# SPDX-License-Identifier: GPL-3.0-or-later
"""The angle from which edges of a shape are sharp."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..portable_angle import angle_of
from ..small_matrices import dot
from .triangles import unit_normals

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..settings import Settings
    from .shape import Shape

# Edges are sharp from this multiple of the angle on: tubes of twelve sides are round, and bent ones have 30.1 degrees.
_CLEARLY = 1.01


def sharp_angle_of(shape: Shape, settings: Settings) -> float:
    """Return the angle in radians from which edges of the shape are sharp."""
    wider = 2.0 if shape.shaded_smooth else _CLEARLY
    return min(wider * settings.sharp_angle, math.pi)


def smooth_bends(shape: Shape, sharp: float) -> NDArray[np.float64]:
    """Return (m,) the largest angle between each face and one across an edge that is not sharp, in radians."""
    normals, _ = unit_normals(shape.points[shape.triangles])
    cosines = np.clip(dot(normals[:, None], normals[shape.neighbours]), -1.0, 1.0)
    angles = angle_of(cosines, np.sqrt(1.0 - cosines**2))
    counted = (shape.neighbours >= 0) & (angles < sharp)
    return np.where(counted, angles, 0.0).max(axis=1, initial=0.0)
