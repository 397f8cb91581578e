# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that are read as those of a solid, whichever way they were drawn (docs/stage_inside.md)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Flags, Floats, Ints
from ..errors import DegenerateInputError
from ..machine import native
from .shape import REPEATED, Shape

# Odd numbers of 64 bits without a pattern, as splitmix64 has them.
_FACTORS = np.array(
    [0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB, 0xD6E8FEB86659FD93], np.uint64
)


def outward_shape(shape: Shape) -> Shape:
    """Return a shape whose faces look outward, and say in `Shape.reading` what was done.

    Rows of points and triangles stay the same. A triangle that repeats another one gets three times the same
    corner, so it counts for nothing in every stage. Faces that are closed, consistent and outward are not touched.

    Raises
    ------
    InvalidInputError
        A corner is no row of the points, or a coordinate is not finite.
    DegenerateInputError
        There are faces, and each of them has two corners in one place.
    """
    if not len(shape.triangles) or shape.reading is not None:
        return shape
    with native.own_errors() as module:
        triangles, reading, _, _ = module.outward_faces(shape.points, shape.triangles)
        again = repeats_of_bodies(shape.points, shape.triangles)
        if again.any():
            once = np.where(again[:, None], shape.triangles[:, :1], shape.triangles)
            triangles, reading, _, _ = module.outward_faces(shape.points, once)
            reading = np.where(again, np.uint8(REPEATED), reading)
    if not reading.any():
        _check_corners(shape)
        return replace(shape, reading=reading)
    return replace(shape, triangles=triangles, reading=reading)


def _check_corners(shape: Shape) -> None:
    """Check that some face has three corners in three places."""
    corners = shape.points[shape.triangles]
    if (corners == np.roll(corners, 1, axis=1)).all(axis=2).any(axis=1).all():
        raise DegenerateInputError(
            f"Expected faces with three corners in three places, found {len(corners):,} without; rebuild the faces, or "
            "give the points alone"
        )


def reading_warnings(shape: Shape) -> Iterator[str]:
    """Say what was read in another way than it was given, a sentence each."""
    counts, faces = shape.reading_counts, len(shape.triangles)
    if turned := counts["turned"]:
        yield (
            f"{turned:,} of {faces:,} faces looked inward and were read the other way round; "
            "the mesh itself is as it was"
        )
    if repeated := counts["repeated"]:
        yield f"{repeated:,} of {faces:,} faces lie on another face with the same corners and were left out"
    if of_sheets := counts["of_sheets"]:
        yield (
            f"{of_sheets:,} of {faces:,} faces are sheets without thickness and were left out; "
            "give them thickness (a Solidify modifier)"
        )


def repeats_of_bodies(points: Floats, triangles: Ints) -> Flags:
    """(m,) mark the faces that repeat an earlier one, in any direction, of parts in which every face is repeated.

    Exports with both sides of each face have such parts. In one body two equal faces may be a wall between two rooms,
    of which none bounds the solid. Where every face of a connected part stands an even number of times, nothing would
    be left of it: there the first of each is meant.
    """
    keys = _keys(points, triangles)
    _, first, of_key, count = np.unique(
        keys, return_index=True, return_inverse=True, return_counts=True
    )
    repeated = np.zeros(len(triangles), bool)
    if len(first) == len(triangles):
        return repeated
    repeated[:] = True
    repeated[first] = False
    with native.own_errors() as module:
        part, _, _ = module.mesh_parts(points, triangles)
    known = part >= 0
    alone = np.zeros(int(part.max(initial=-1)) + 2, bool)  # the last one is of no part, -1
    alone[part[known & (count[of_key] % 2 == 1)]] = True
    return repeated & known & ~alone[part]


def _keys(points: Floats, triangles: Ints) -> NDArray[np.uint64]:
    """Return a number for the corners of each face, (m,), in any order; equal coordinates are one corner."""
    bits = np.ascontiguousarray(points + 0.0).view(np.uint64)  # -0.0 is 0.0
    corner = np.zeros(len(points), np.uint64)
    for axis in range(3):
        corner = (corner ^ bits[:, axis]) * _FACTORS[axis]
        corner ^= corner >> np.uint64(29)
    corner *= _FACTORS[3]
    corner ^= corner >> np.uint64(32)
    return np.asarray(corner[triangles].sum(axis=1, dtype=np.uint64))
