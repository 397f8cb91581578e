# SPDX-License-Identifier: GPL-3.0-or-later
"""The way from the measured surface back to the faces of the shape: the triangle that represents each face."""

from __future__ import annotations

import numpy as np

from ..arrays import Flags, Floats, Ints
from ..machine import native
from ..shape.shape import Shape


def face_of_triangles(triangles: Ints, at_edge: Flags, faces: Ints | None) -> Ints:
    """(f,) the face of the shape in which all corners of a measured triangle lie; -1 where there is none.

    Corners on sharp edges lie in two faces and do not count.

    The (f, 3) triangles are rows of samples, which lie on (n,) faces; -1 where there is none.
    """
    if faces is None:
        return np.full(len(triangles), -1, np.int32)
    face = faces.astype(np.int64)
    face[at_edge] = -1
    corners = face[triangles]
    highest = corners.max(axis=1)
    same = (corners == highest[:, None]) | (corners < 0)
    return np.where(same.all(axis=1), highest, -1).astype(np.int32)


def thinnest_of_faces(
    shape: Shape, points: Floats, triangles: Ints, lengths: Floats, at_edge: Flags, inside: Ints
) -> Ints:
    """(m,) for each face of the shape the thinnest triangle of the measured surface that lies in it.

    For a face without such a triangle it is the thinnest triangle at the sample nearest to the middle of the face, and
    -1 for all faces where there is no measured surface. Triangles without corners on sharp edges are preferred.

    The measured surface has (n, 3) samples, some of them at sharp edges, and (f, 3) triangles with lengths; `inside` is
    as `face_of_triangles` returns it.
    """
    faces = shape.triangles
    thinnest = np.full(len(faces), -1, np.int32)
    if not len(faces) or not len(triangles):
        return thinnest
    order = np.argsort(-lengths, kind="stable").astype(np.int32)  # the thinnest last
    inside = inside[order]
    by_edge = at_edge[triangles[order]].any(axis=1)
    for some in (by_edge & (inside >= 0), ~by_edge & (inside >= 0)):
        thinnest[inside[some]] = order[some]  # the preferred ones overwrite the others
    bare = np.flatnonzero(thinnest < 0)
    at_sample = np.full(len(points), -1, np.int32)
    at_sample[triangles[order]] = order[:, None]
    middles = shape.points[faces[bare]].mean(axis=1)
    used = np.flatnonzero(at_sample >= 0)
    with native.own_errors() as module:
        nearest = module.nearest(points[used], middles)
    thinnest[bare] = at_sample[used[nearest]]
    return thinnest
