# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces that are read as those of a solid, whichever way they were drawn (docs/stage_inside.md)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..errors import DegenerateInputError
from ..machine import native
from .repeated_faces import repeats_of_bodies
from .shape import OF_SHEETS, REPEATED, TURNED, WITHOUT_CORNERS, Shape


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


def none_left(shape: Shape) -> DegenerateInputError:
    """Return the error for faces each of which counts for nothing, so that none can decide what is inside."""
    return DegenerateInputError(
        f"Expected faces that bound a solid, found {len(shape.triangles):,} that repeat others, are sheets or have "
        "no three corners; give them thickness (a Solidify modifier), or choose Inside From Tight Cocone"
    )


def reading_counts(shape: Shape) -> dict[str, int]:
    """Return how many faces were read the other way round, and how many were left out and why."""
    reading = np.zeros(0, np.uint8) if shape.reading is None else shape.reading
    counts = np.bincount(reading, minlength=5)
    return {
        "turned": int(counts[TURNED]),
        "repeated": int(counts[REPEATED]),
        "without_corners": int(counts[WITHOUT_CORNERS]),
        "of_sheets": int(counts[OF_SHEETS]),
    }


def reading_warnings(shape: Shape) -> Iterator[str]:
    """Say what was read in another way than it was given, a sentence each."""
    counts, faces = reading_counts(shape), len(shape.triangles)
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
