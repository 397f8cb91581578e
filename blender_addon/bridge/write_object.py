"""A medial axis -> a Blender mesh with attributes. Here alone float64 becomes float32."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.errors import InvalidInputError
from .attributes import attributes

if TYPE_CHECKING:
    from ..core.analysis import MedialAxis


def new_mesh(axis: MedialAxis, name: str) -> bpy.types.Mesh:
    """A mesh of n-gons, flat shaded, with the attributes of the table, or no mesh at all.

    Raises
    ------
    InvalidInputError
        Coordinates too large for Blender.
    """
    positions = _positions(axis)
    _check_faces(axis)
    mesh = bpy.data.meshes.new(name)
    try:
        _set_faces(mesh, axis, positions)
        for attribute in attributes():
            data = mesh.attributes.new(attribute.name, attribute.type, attribute.domain).data
            data.foreach_set("value", attribute.values(axis))
    except BaseException:
        bpy.data.meshes.remove(mesh)
        raise
    return mesh


def _positions(axis: MedialAxis) -> np.ndarray:
    with np.errstate(over="ignore"):
        positions = np.ascontiguousarray(axis.vertices, np.float32).ravel()
    if not np.isfinite(positions).all():
        raise InvalidInputError(
            f"Expected coordinates below {np.finfo(np.float32).max:.3g}, which Blender can hold, "
            "found larger ones on the medial axis; scale the object down, or choose side Inner"
        )
    return positions


def _check_faces(axis: MedialAxis) -> None:
    """Blender trusts these arrays; a wrong index would end it.

    (`mesh.validate` takes longer than all the rest.)
    """
    corners = np.diff(axis.face_offsets)
    inside = (axis.face_vertices >= 0) & (axis.face_vertices < len(axis.vertices))
    whole = axis.face_offsets[0] == 0 and axis.face_offsets[-1] == len(axis.face_vertices)
    if not (whole and inside.all() and corners.min(initial=3) >= 3):
        raise AssertionError("the arrays of a medial axis contradict each other")


def _set_faces(mesh: bpy.types.Mesh, axis: MedialAxis, positions: np.ndarray) -> None:
    mesh.vertices.add(len(axis.vertices))
    mesh.loops.add(len(axis.face_vertices))
    mesh.polygons.add(axis.facets)
    mesh.polygons.foreach_set("loop_start", np.ascontiguousarray(axis.face_offsets[:-1], np.int32))
    if bpy.app.version < (4, 1, 0):  # afterwards it follows from loop_start and cannot be written
        mesh.polygons.foreach_set("loop_total", np.diff(axis.face_offsets).astype(np.int32))
    corners = np.ascontiguousarray(axis.face_vertices, np.int32)
    if ".corner_vert" in mesh.attributes:  # from 3.6 or so, and many times faster
        mesh.attributes["position"].data.foreach_set("vector", positions)
        mesh.attributes[".corner_vert"].data.foreach_set("value", corners)
    else:
        mesh.vertices.foreach_set("co", positions)
        mesh.loops.foreach_set("vertex_index", corners)
    mesh.update(calc_edges=True)
    if hasattr(mesh, "shade_flat"):  # from 4.1, where smooth is the default
        mesh.shade_flat()
