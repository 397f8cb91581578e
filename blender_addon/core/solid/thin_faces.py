# SPDX-License-Identifier: GPL-3.0-or-later
"""From the measured surface back to the faces of the shape: which of its triangles speaks for which face."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..machine import native

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .thickness import Measurement


def sample_triangle_of_faces(found: Measurement) -> NDArray[np.int32]:
    """(m,) for each face of the shape the thinnest triangle of the measured surface that lies in it; for a face in
    which none does, the thinnest at the sample next to its middle; -1 for all where there is no surface.

    A triangle lies in a face when its corners do, those on sharp edges left aside, which lie in two. Triangles without
    such corners come first.
    """
    shape = found.shape
    faces = shape.triangles
    if found.triangles is faces:
        return np.arange(len(faces), dtype=np.int32)
    thinnest = np.full(len(faces), -1, np.int32)
    if not len(faces) or not len(found.triangles):
        return thinnest
    order = np.argsort(-found.of_triangles, kind="stable").astype(np.int32)  # the thinnest last
    inside = _face_of_triangles(found)[order]
    by_edge = found.at_edge[found.triangles[order]].any(axis=1)
    for some in (
        by_edge & (inside >= 0),
        ~by_edge & (inside >= 0),
    ):  # the better ones overwrite the others
        thinnest[inside[some]] = order[some]
    bare = np.flatnonzero(thinnest < 0)
    at_sample = np.full(len(found.points), -1, np.int32)
    at_sample[found.triangles[order]] = order[:, None]
    middles = shape.points[faces[bare]].mean(axis=1)
    used = np.flatnonzero(at_sample >= 0)
    with native.own_errors() as module:
        nearest = module.nearest(found.points[used], middles)
    thinnest[bare] = at_sample[used[nearest]]
    return thinnest


def _face_of_triangles(found: Measurement) -> NDArray[np.int32]:
    """(f,) the face in which all corners of a measured triangle lie; -1: none."""
    samples = found.chosen.samples
    if samples.faces is None:
        return np.full(len(found.triangles), -1, np.int32)
    face = samples.faces.astype(np.int64)
    face[found.at_edge] = -1
    corners = face[found.triangles]
    highest = corners.max(axis=1)
    same = (corners == highest[:, None]) | (corners < 0)
    return np.where(same.all(axis=1), highest, -1).astype(np.int32)
