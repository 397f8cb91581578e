# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons as triangles without new vertices; files and meshes in Blender give the same triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..machine import native
from .medial_axis import MedialAxis

_CHUNK = 1 << 15  # the number of polygons cut at once; bounds the memory


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


def triangulate_facets(vertices: Floats, face_offsets: Ints, face_vertices: Ints) -> Ints:
    """Return (c - 2 f, 3) int32 the triangles of planar and convex facets, of which none is without area.

    A fan from a fixed corner degenerates where that corner lies on a straight side (Voronoi facets of nearly
    cospherical samples have such corners). Here ears are cut one by one so that neither the ear nor what remains is
    thin, which always succeeds on a convex polygon that has an area. The arguments and the order are those of
    `polygon_triangles`.
    """
    counts = np.diff(face_offsets)
    first_triangle = face_offsets[:-1] - 2 * np.arange(len(counts), dtype=face_offsets.dtype)
    triangles = np.empty((max(len(face_vertices) - 2 * len(counts), 0), 3), np.int32)
    for count in np.unique(counts):
        alike = np.flatnonzero(counts == count)
        for start in range(0, len(alike), _CHUNK):
            ids = alike[start : start + _CHUNK]
            corners = face_vertices[face_offsets[ids][:, None] + np.arange(count)]
            places = first_triangle[ids][:, None] + np.arange(count - 2)
            triangles[places] = _cut_ears(vertices[corners], corners)
    return triangles


def _cut_ears(points: Floats, corners: Ints) -> Ints:
    """Return (m, k - 2, 3) triangles of polygons with (m, k, 3) points and (m, k) corners."""
    x, y = _flattened(points)
    rows = np.arange(len(corners))
    ears = []
    while (size := corners.shape[1]) > 3:
        tip = _best_ear(x, y)
        ears.append(np.stack([corners[rows, (tip + step) % size] for step in (-1, 0, 1)], axis=1))
        kept = np.arange(size) != tip[:, None]
        x, y = (values[kept].reshape(len(rows), size - 1) for values in (x, y))
        corners = corners[kept].reshape(len(rows), size - 1)
    return np.stack([*ears, corners], axis=1)


def _flattened(points: Floats) -> tuple[Floats, Floats]:
    """x and y, each (m, k): the polygons seen along the axis nearest to their normal.

    All areas of one polygon shrink by the same factor, so comparing them stays valid; the signs may turn.
    """
    around = points - points[:, :1]
    normal = np.cross(around[:, 1:-1], around[:, 2:]).sum(axis=1)
    across = np.abs(normal).argmax(axis=1)
    rows = np.arange(len(points))
    return around[rows, :, (across + 1) % 3], around[rows, :, (across + 2) % 3]


def _best_ear(x: Floats, y: Floats) -> NDArray[np.intp]:
    """Return the corner of each (m, k) polygon where the smaller of ear and remainder is largest, (m,)."""
    x_next, y_next = np.roll(x, -1, axis=1), np.roll(y, -1, axis=1)
    x_last, y_last = np.roll(x, 1, axis=1), np.roll(y, 1, axis=1)
    ear = (x - x_last) * (y_next - y) - (y - y_last) * (x_next - x)
    whole = (x * y_next - y * x_next).sum(axis=1, keepdims=True)
    turn = np.where(whole < 0.0, -1.0, 1.0)
    return np.minimum(turn * ear, turn * (whole - ear)).argmax(axis=1)
