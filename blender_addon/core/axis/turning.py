# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets turned round, so that those of a sheet agree."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Flags, Ints
from .medial_axis import MedialAxis


def with_facets_turned(axis: MedialAxis, which: Flags) -> MedialAxis:
    """Return the axis with the facets that (f,) bool marks turned round; the first corner stays.

    Their generators are exchanged, so every facet still turns counter-clockwise about the direction between them.
    """
    corners = turned_corners(axis.face_offsets, axis.face_vertices)
    of_corner = np.repeat(which, np.diff(axis.face_offsets))
    return replace(
        axis,
        face_vertices=np.where(of_corner, corners, axis.face_vertices),
        generators=np.where(which[:, None], axis.generators[:, ::-1], axis.generators),
    )


def turned_corners(face_offsets: Ints, face_vertices: Ints) -> Ints:
    """Return the corners of each polygon in reverse order after the same first corner."""
    first = np.repeat(face_offsets[:-1], np.diff(face_offsets))
    last = np.repeat(face_offsets[1:], np.diff(face_offsets))
    corner = np.arange(len(face_vertices))
    return face_vertices[np.where(corner == first, corner, first + last - corner)]
