# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices, polygons and edges of a Blender mesh -> arrays, each copied in one go where Blender can.

It can where the array has the type that Blender keeps; else it converts number by number, which takes 10 to 20 times
as long. Attributes of corners, from 3.6 or so, are signed; what older names give is unsigned.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Flags, Floats, Ints
from .attributes import read_vectors


def read_positions(mesh: bpy.types.Mesh) -> Floats:
    """Return the vertices, (n, 3)."""
    if "position" in mesh.attributes:  # from 3.6 or so; then it alone is copied in one go
        return read_vectors(mesh.attributes["position"].data, "vector")
    return read_vectors(mesh.vertices, "co")


def read_polygons(mesh: bpy.types.Mesh) -> tuple[Ints, Ints]:
    """(m + 1,) where the corners of each polygon begin, and (c,) the vertices of the corners, polygon by polygon."""
    starts, sizes = read_spans(mesh)
    offsets = np.zeros(len(sizes) + 1, np.int32)
    np.cumsum(sizes, out=offsets[1:])
    # Up to 3.6 polygons need not lie in the order of their corners.
    places = np.arange(offsets[-1]) + np.repeat(starts - offsets[:-1], sizes)
    return offsets, read_corners(mesh)[places]


def read_spans(mesh: bpy.types.Mesh) -> tuple[Ints, Ints]:
    """Return (m,) the first corner of each polygon, and (m,) how many it has."""
    starts = _read_unsigned(mesh.polygons, "loop_start")
    if bpy.app.version < (4, 1, 0):
        return starts, _read_unsigned(mesh.polygons, "loop_total")
    return starts, np.diff(starts, append=np.int32(len(mesh.loops)))


def read_corners(mesh: bpy.types.Mesh) -> Ints:
    """Return the vertex of each corner, (c,)."""
    return _read_of_corners(mesh, ".corner_vert", "vertex_index")


def read_corner_edges(mesh: bpy.types.Mesh) -> Ints:
    """Return the edge that begins at each corner, (c,)."""
    return _read_of_corners(mesh, ".corner_edge", "edge_index")


def read_edges(mesh: bpy.types.Mesh) -> Ints:
    """Return the ends of each edge, (e, 2)."""
    return _read_unsigned(mesh.edges, "vertices", 2).reshape(-1, 2)


def read_loop_triangles(mesh: bpy.types.Mesh) -> tuple[Ints, Ints]:
    """Return (t, 3) Blender's own triangles, and (t,) the polygon of each."""
    mesh.calc_loop_triangles()
    triangles = mesh.loop_triangles
    corners = _read_unsigned(triangles, "vertices", 3).reshape(-1, 3)
    return corners, _read_unsigned(triangles, "polygon_index")


def _read_of_corners(mesh: bpy.types.Mesh, attribute: str, older: str) -> Ints:
    if attribute not in mesh.attributes:
        return _read_unsigned(mesh.loops, older)
    values = np.empty(len(mesh.loops), np.int32)
    mesh.attributes[attribute].data.foreach_get("value", values)
    return values


def _read_unsigned(elements: bpy.types.bpy_prop_collection, name: str, each: int = 1) -> Ints:
    """`each` numbers of every element."""
    values = np.empty(each * len(elements), np.uint32)
    elements.foreach_get(name, values)
    return values.view(np.int32)


def selected_faces(mesh: bpy.types.Mesh) -> Flags:
    """Return which faces are selected in edit mode, (p,)."""
    selected = np.zeros(len(mesh.polygons), bool)
    mesh.polygons.foreach_get("select", selected)
    return selected


def select_faces(mesh: bpy.types.Mesh, wanted: Flags) -> None:
    """Select the faces that (m,) bool marks and nothing else, with their edges and vertices.

    So every select mode shows the same.
    """
    starts, sizes = read_spans(mesh)
    of_corner = np.zeros(len(mesh.loops), bool)
    for start, size in zip(starts[wanted].tolist(), sizes[wanted].tolist(), strict=True):
        of_corner[start : start + size] = True
    for elements, at in (
        (mesh.vertices, read_corners(mesh)),
        (mesh.edges, read_corner_edges(mesh)),
    ):
        flags = np.zeros(len(elements), bool)
        flags[at[of_corner]] = True
        elements.foreach_set("select", flags)
    mesh.polygons.foreach_set("select", wanted)
    mesh.update()
