# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets: faces that agree where they meet, and their rims."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..errors import InvalidInputError
from ..shape.outward_faces import outward_shape, reading_warnings
from ..shape.shape import Shape
from ..shape.triangles import side_keys
from ..small_matrices import dot
from ..thickness.face_lengths import first_rows


@dataclass(frozen=True, eq=False)
class Sheet:
    """Faces as a sheet."""

    points: Floats  # (v, 3) Vertices with the same coordinates are one
    # (m, 3) As seen from the front; every side has one other triangle at most, which passes it the other way
    triangles: Ints
    row: Longs  # (v,) The rows of the vertices in the points of the shape
    warnings: tuple[str, ...]


def sheet_of(shape: Shape, selected: Flags | None = None) -> Sheet:
    """Return the faces of a shape, or those that are selected, as a sheet.

    Faces keep the side to which they look, unless they do not agree with each other.

    Raises
    ------
    InvalidInputError
        There are no faces, more than two meet at an edge, or a sheet has one side only.
    """
    _ = shape.open_edges  # it raises where corners are no rows of the points
    if selected is not None:
        shape = replace(shape, triangles=shape.triangles[selected], reading=None)
    faces = _faces(shape)
    warnings: tuple[str, ...] = ()
    if len(faces) and any(_disagreeing(faces)):
        shape = outward_shape(shape)
        faces, warnings = _faces(shape), tuple(reading_warnings(shape))
    if not len(faces):
        raise InvalidInputError("Expected faces, found none; add some, or select them")
    many, turned = _disagreeing(faces)
    if many:
        raise InvalidInputError(
            f"Expected two faces at most at every edge, found {many:,} edges with more; split the mesh there, or "
            "select the faces of one sheet"
        )
    if turned:
        raise InvalidInputError(
            f"Expected faces that agree which side is the front, found {turned:,} edges where they cannot, as on a "
            "strip that is twisted; split the mesh there"
        )
    row, corners = np.unique(faces, return_inverse=True)
    triangles = corners.reshape(-1, 3).astype(np.int32)
    return Sheet(shape.points[row], triangles, row.astype(np.int64), warnings)


def _faces(shape: Shape) -> Ints:
    """(m, 3) the triangles with three corners in three places."""
    faces = first_rows(shape.points)[shape.triangles].astype(np.int32)
    return np.ascontiguousarray(faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)])


def _disagreeing(faces: Ints) -> tuple[int, int]:
    """The number of edges with more than two faces, and of the others that two faces pass the same way."""
    start, end = faces.astype(np.int64), np.roll(faces, -1, axis=1)
    count = int(faces.max()) + 1
    _, uses = np.unique(side_keys(faces, count), return_counts=True)
    _, ways = np.unique(start * count + end, return_counts=True)
    many = int((uses > 2).sum())
    return many, 0 if many else int((ways > 1).sum())


def rim_sides(triangles: Ints) -> Longs:
    """Return the sides of triangles that no other one has, (e, 3): where they start and end, and the third corner."""
    sides = np.stack([np.roll(triangles, -corner, axis=1) for corner in range(3)], axis=1)
    sides = sides.reshape(-1, 3).astype(np.int64)
    count = int(sides.max()) + 1
    keys, back = sides[:, 0] * count + sides[:, 1], sides[:, 1] * count + sides[:, 0]
    return np.asarray(sides[~np.isin(keys, back)], np.int64)


def beyond_rims(points: Floats, triangles: Ints, length: float) -> tuple[Floats, Ints]:
    """Return a sheet that goes straight on from its rims, and in the corners between these strips."""
    sides = rim_sides(triangles)
    start, end, third = sides.T
    along, across = points[end] - points[start], points[third] - points[start]
    size = dot(along, along)
    out = along * (dot(along, across) / np.where(size > 0.0, size, 1.0))[:, None] - across
    size = np.sqrt(dot(out, out))
    out *= (length / np.where(size > 0.0, size, 1.0))[:, None]
    first = len(points) + np.arange(len(sides))
    last = first + len(sides)
    before, after = np.argsort(end, kind="stable"), np.argsort(start, kind="stable")
    corners = np.column_stack((start[after], first[after], last[before]))
    strips = np.column_stack((start, end, last)), np.column_stack((start, last, first))
    faces = np.concatenate((triangles, *strips, corners)).astype(np.int32)
    return np.concatenate((points, points[start] + out, points[end] + out)), faces
