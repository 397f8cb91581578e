# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of cubes, as of voxel art: their steps are meant."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from ..small_matrices import dot
from .triangles import unit_normals

# In radians: rounding to float32 turns a side far less, and noise most sides more.
_TURNED = 0.01  # chosen: unseen
# A share of the area: the rest may be grass and the like. Surfaces that programs make of voxels have at most 0.65,
# unless the shape is a box, which has no noise.
_NEARLY_ALL = 0.98  # measured: 0.65 and 1
_TRIED = 8  # triangles for the first direction: any of them may be grass


def are_cubes(points: Floats, triangles: Ints) -> bool:
    """Return whether nearly all of the area looks along three directions that are perpendicular to each other.

    Parameters
    ----------
    points : (n, 3) float64
        In a unit in which the squares of areas are finite.
    triangles : (m, 3) int32
        At least one.
    """
    normals, area = unit_normals(points[triangles])
    tried = np.linspace(0, len(normals) - 1, _TRIED).astype(np.int64)
    most = max(_area_along(normals, area, normals[one]) for one in tried)
    return bool(most >= _NEARLY_ALL * area.sum())


def _area_along(normals: Floats, area: Floats, first: Floats) -> float:
    """The area that looks along a direction, or along that of the largest triangle across, or across both."""
    across = np.abs(dot(normals, first)) < _TURNED
    second = normals[np.where(across, area, 0.0).argmax()]
    along = np.zeros(len(area), bool)
    for direction in (first, second, np.cross(first, second)):
        along |= np.abs(dot(normals, direction)) > 1.0 - _TURNED**2 / 2.0
    return float(area[along].sum())
