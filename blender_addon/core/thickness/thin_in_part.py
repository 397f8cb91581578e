# SPDX-License-Identifier: GPL-3.0-or-later
"""Large faces that are thin in one part and not in another, and their division.

Only vertices can move, and those of such a face are not where it is thin.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Ints
from ..settings import Edges, Settings, ThicknessSettings
from ..shape.outward_faces import outward_shape
from ..shape.shape import Shape
from .face_lengths import are_enough, first_rows, longest_piece
from .fine_faces import coarse_faces, cut_faces
from .measurement import Measurement
from .thickness import measure_thickness

_SOME = 0.02  # a smaller part of a face does not count; chosen: unseen
DIVISIONS = 3  # at most; one suffices unless the new vertices make the samples denser


def thin_in_part(found: Measurement, limit: float) -> Flags:
    """(m,) the faces that were cut for a measurement, and are thinner than a limit in one part of their area and not in
    another."""
    face, count = found.surface.face_of_triangles, len(found.shape.triangles)
    if face is None or found.triangles is found.shape.triangles:
        return np.zeros(count, bool)
    lengths = found.of_walls
    thin = lengths < limit - found.slack
    area, part, rest = (
        np.bincount(face, weights, minlength=count)
        for weights in (
            found.areas,
            found.areas * thin,
            found.areas * (np.isfinite(lengths) & ~thin),
        )
    )
    return np.asarray((part > _SOME * area) & (rest > _SOME * area))


def faces_to_divide(shape: Shape, settings: Settings, limit: float) -> tuple[Flags, float]:
    """Find the faces that have to be divided before their walls can gain what they lack.

    There are none where the faces do not bound one solid, or the limit is 0.

    Parameters
    ----------
    shape : Shape
    settings : Settings
        Its options of sampling decide how large pieces are.
    limit : float

    Returns
    -------
    faces : (m,) bool
    longest : float
        Pieces with shorter edges show their thickness at their corners.
    """
    shape, longest = outward_shape(shape), longest_piece(shape, settings)
    wanted = ThicknessSettings(limit=limit, edges=Edges.GREY)
    if math.isinf(longest) or not (limit > 0.0 and are_enough(shape, settings, wanted)):
        return np.zeros(len(shape.triangles), bool), longest
    return thin_in_part(measure_thickness(shape, settings, wanted), limit), longest


def subdivided(shape: Shape, settings: Settings, limit: float) -> tuple[Shape, NDArray[np.intp]]:
    """Divide the faces of a solid that are thin in part; the solid stays the same.

    Returns
    -------
    shape : Shape
        Its first points are those of the shape.
    face : (k,) int
        The face of the shape in which each triangle lies.
    """
    face = np.arange(len(shape.triangles))
    for _ in range(DIVISIONS):
        some, longest = faces_to_divide(shape, settings, limit)
        if not some.any():
            break
        shape, pieces = _divided(shape, some, longest)
        face = face[pieces]
    return shape, face


def _divided(shape: Shape, some: Flags, longest: float) -> tuple[Shape, Ints]:
    row = first_rows(shape.points).astype(np.int32)
    sharp = row[np.zeros((0, 2), np.int32) if shape.sharp_edges is None else shape.sharp_edges]
    kinds = np.ones(len(sharp), np.int8)
    coarse = coarse_faces(shape.points, row[shape.triangles], sharp, kinds)
    fine = cut_faces(coarse, longest, some)
    rows, sides = np.nonzero(fine.kinds)
    ends = fine.triangles[rows[:, None], np.column_stack((sides, (sides + 1) % 3))]
    made = replace(
        shape,
        points=fine.points,
        triangles=fine.triangles,
        normals=None,
        sharp_edges=None if shape.sharp_edges is None else np.unique(np.sort(ends, axis=1), axis=0),
        rows=None,
        reading=None,
    )
    return outward_shape(made), fine.faces
