# SPDX-License-Identifier: GPL-3.0-or-later
"""A medial axis within a box: facets that reach out of it are cut off at its sides.

This is for axes as published, which consist of facets only. Their facets are convex, so each side of the box leaves
one polygon of each (Sutherland and Hodgman 1974). Facets that share an edge share the new vertex on it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Flags, Floats, Ints, Longs
from ..small_matrices import dot
from .cut import with_facets
from .directions import corners_after
from .medial_axis import MedialAxis


def within_box(axis: MedialAxis, low: Floats, high: Floats, times: float) -> MedialAxis:
    """Keep what lies in the box from `low` to `high`, enlarged about its middle.

    The (3,) corners move apart by the factor `times`; 0 keeps everything.
    """
    if times <= 0.0 or not axis.facets:
        return axis
    middle, half = (low + high) / 2, times * (high - low) / 2
    for k in range(3):
        for sign in (-1.0, 1.0):
            axis = _cut_at(axis, k, sign, float(middle[k] + sign * half[k]))
    return axis


def _cut_at(axis: MedialAxis, k: int, sign: float, side: float) -> MedialAxis:
    """Keep the part of each facet that is not beyond a side of the box, across axis k in the direction of `sign`."""
    beyond = sign * (axis.vertices[:, k] - side)
    if not (beyond > 0.0).any():
        return axis
    ends = np.column_stack(
        (axis.face_vertices, axis.face_vertices[corners_after(axis.face_offsets)])
    )
    crosses = np.sign(beyond[ends]).prod(axis=1) < 0.0
    # The end within comes first, so that the new vertex is the same in all facets of the edge.
    edges = np.where((beyond[ends[:, 0]] > 0.0)[:, None], ends[:, ::-1], ends)[crosses]
    edges, which = np.unique(edges, axis=0, return_inverse=True)
    new = len(axis.vertices) + which.ravel()
    return _with_corners(
        _with_vertices(axis, edges, beyond, k, side), beyond[ends[:, 0]] <= 0.0, crosses, new
    )


def _with_vertices(
    axis: MedialAxis, edges: Ints, beyond: Floats, k: int, side: float
) -> MedialAxis:
    """Add a vertex on each edge where it leaves the box; the first end of an edge is within."""
    start, end = edges.T
    share = beyond[start] / (beyond[start] - beyond[end])
    way = axis.vertices[end] - axis.vertices[start]
    places = axis.vertices[start] + share[:, None] * way
    places[:, k] = side
    # The square of the distance from a sample along a line is a parabola.
    length, near = np.sqrt(dot(way, way)), axis.radius[start]
    ascent = (axis.radius[end] - length) * (axis.radius[end] + length) - near * near
    square = near * near + share * ascent + (share * length) ** 2
    gone = share * length
    radius = np.clip(np.sqrt(np.maximum(square, 0.0)), np.maximum(near - gone, 0.0), near + gone)
    return replace(
        axis,
        vertices=np.concatenate((axis.vertices, places)),
        radius=np.concatenate((axis.radius, radius)),
    )


def _with_corners(axis: MedialAxis, stays: Flags, crosses: Flags, new: Longs) -> MedialAxis:
    """Keep corners of facets, and give those whose edge leaves or enters the box a new corner after them."""
    count = stays.astype(np.int64) + crosses
    last = np.cumsum(count)
    corners = np.empty(int(last[-1]), np.int32)
    corners[(last - count)[stays]] = axis.face_vertices[stays]
    corners[last[crosses] - 1] = new
    offsets = np.concatenate(([0], last))[axis.face_offsets].astype(np.int32)
    whole = replace(axis, face_offsets=offsets, face_vertices=corners)
    return with_facets(whole, np.diff(offsets) > 2)
