# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons as triangles without new vertices; files and meshes in Blender give the same triangles."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Ints
from ..machine import native
from .facet_triangles import triangulate_facets
from .medial_axis import MedialAxis


def polygon_triangles(points: Floats, face_offsets: Ints, face_vertices: Ints) -> Ints:
    """Return (c - 2 f, 3) int32 the triangles of polygon after polygon, each turning as its polygon does.

    Quads are cut as in Blender, larger polygons by their constrained Delaunay triangulation.

    Parameters
    ----------
    points : (n, 3) float64
    face_offsets : (f + 1,) int32
        Polygon i has the corners `face_vertices[face_offsets[i]:face_offsets[i + 1]]`, three at least.
    face_vertices : (c,) int32
        Rows of `points`.
    """
    if len(face_vertices) == 3 * (len(face_offsets) - 1):
        return face_vertices.reshape(-1, 3)
    with native.own_errors() as module:
        return np.asarray(module.polygon_triangles(points, face_offsets, face_vertices))


def axis_triangles(axis: MedialAxis) -> Ints:
    """Return (c - 2 f, 3) int32 the triangles of facet after facet, each turning as its facet does.

    Polygons of a small medial mesh, which have no generators, need not be convex.
    """
    polygons = axis.face_offsets, axis.face_vertices
    if (axis.generators < 0).any():
        return polygon_triangles(np.ascontiguousarray(axis.vertices), *polygons)
    return triangulate_facets(axis.vertices, *polygons)
