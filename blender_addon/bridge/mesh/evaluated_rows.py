# SPDX-License-Identifier: GPL-3.0-or-later
"""The vertices of a mesh among those that its modifiers leave.

Modifiers may reorder vertices and faces without changing their number (Build, Sort Elements), so equal counts say
nothing. An index that travels through the evaluation as an attribute says which vertex became which.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Ints
from .attributes import read_attribute

_INDEX = "ma_index_in_mesh"
# Modifiers that move vertices, and leave their number and order.
_DEFORMING = {
    "ARMATURE",
    "CAST",
    "CLOTH",
    "COLLISION",
    "CORRECTIVE_SMOOTH",
    "CURVE",
    "DISPLACE",
    "HOOK",
    "LAPLACIANDEFORM",
    "LAPLACIANSMOOTH",
    "LATTICE",
    "MESH_DEFORM",
    "SHRINKWRAP",
    "SIMPLE_DEFORM",
    "SMOOTH",
    "SOFT_BODY",
    "SURFACE_DEFORM",
    "WARP",
    "WAVE",
    "NORMAL_EDIT",
    "WEIGHTED_NORMAL",
    "UV_PROJECT",
    "UV_WARP",
    "VERTEX_WEIGHT_EDIT",
    "VERTEX_WEIGHT_MIX",
    "VERTEX_WEIGHT_PROXIMITY",
}


def row_of_vertices(source: bpy.types.Object) -> Ints | None:
    """Return the row of each vertex of a mesh among the evaluated vertices, (v,).

    None where a vertex is missing there or is there more than once. The mesh must be writable.
    """
    return _rows(source, "POINT", len(source.data.vertices))


def keeps_rows(source: bpy.types.Object) -> bool:
    """Return whether the evaluated mesh has the vertices and faces of the mesh itself, in the same order."""
    mesh = source.data
    found = (
        _rows(source, domain, len(elements))
        for domain, elements in (("POINT", mesh.vertices), ("FACE", mesh.polygons))
    )
    return all(rows is not None and (np.diff(rows) == 1).all() for rows in found)


def only_deforms(source: bpy.types.Object) -> bool:
    """Return whether no modifier that is shown changes the number or the order of vertices."""
    return all(m.type in _DEFORMING or not m.show_viewport for m in source.modifiers)


def _rows(source: bpy.types.Object, domain: str, count: int) -> Ints | None:
    if only_deforms(source):
        return np.arange(count, dtype=np.int32)
    origin = _origins(source, domain, count)
    if len(origin) != count or not np.array_equal(np.sort(origin), np.arange(count)):
        return None
    rows = np.empty(count, np.int32)
    rows[origin] = np.arange(count, dtype=np.int32)
    return rows


def _origins(source: bpy.types.Object, domain: str, count: int) -> Ints:
    """The index in the mesh of each evaluated vertex or face; empty where the modifiers drop the attribute."""
    mesh = source.data
    attribute = mesh.attributes.new(_INDEX, "INT", domain)
    name = attribute.name  # another one where an artist has this name
    try:
        attribute.data.foreach_set("value", np.arange(count, dtype=np.int32))
        mesh.update()
        bpy.context.view_layer.update()
        evaluated = source.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        origin = read_attribute(evaluated.attributes, name, "INT", domain)
        return np.empty(0, np.int32) if origin is None else origin
    finally:
        mesh.attributes.remove(mesh.attributes[name])
        mesh.update()
