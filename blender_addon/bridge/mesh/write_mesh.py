# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons and edges -> a Blender mesh with attributes. Here alone float64 becomes float32."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.arrays import Floats, Ints
from ...core.axis.medial_axis import MedialAxis, no_edges
from ...core.axis.structure import SEAM, Structure
from ...core.errors import InvalidInputError
from .attributes import (
    LEVEL_ATTRIBUTES,
    NORMAL,
    STRUCTURE_ATTRIBUTES,
    TANGENT,
    Attribute,
    attributes,
)
from .axis_arrays import AxisArrays, arrays_of, edges_of


class Polygons(Protocol):
    """The arrays of a mesh, as in `MedialAxis`."""

    vertices: Floats
    face_offsets: Ints
    face_vertices: Ints


def new_axis_mesh(
    axis: MedialAxis, name: str | bpy.types.Mesh, arrays: AxisArrays | None = None
) -> bpy.types.Mesh:
    """A medial axis as a mesh with all attributes, or no mesh at all, as `new_mesh`.

    `arrays` are those of the axis, where a thread has computed them.
    """
    if arrays is None:
        arrays = arrays_of(axis)
    edges = arrays.edges, arrays.corner_edges
    mesh = new_mesh(arrays.turned, name, attributes(), axis.edges, edges)
    with _removed_on_error(mesh, name):
        _add_vectors(mesh, NORMAL, arrays.normals)
        _add_vectors(mesh, TANGENT, arrays.tangents)
        if axis.level is None:
            return mesh
        _add_attributes(mesh, axis.level, LEVEL_ATTRIBUTES)
        if axis.structure is not None:
            _add_structure(mesh, axis.structure)
            _shade_by_side(mesh, np.diff(axis.face_offsets))
    return mesh


def _add_vectors(mesh: bpy.types.Mesh, name: str, vectors: NDArray[np.float32] | None) -> None:
    """Add (v, 3) vectors at the vertices, along which instances are turned, where there are any."""
    if vectors is not None:
        data = mesh.attributes.new(name, "FLOAT_VECTOR", "POINT").data
        data.foreach_set("vector", vectors.ravel())


def _add_structure(mesh: bpy.types.Mesh, structure: Structure) -> None:
    """Add the attributes of sheets and seams, and shade the sheets smooth between their seams.

    Blender takes edges of other than two faces for sharp by itself.
    """
    alone = len(mesh.edges) - len(structure.seam)
    for attribute in STRUCTURE_ATTRIBUTES:
        data = mesh.attributes.new(attribute.name, attribute.type, attribute.domain).data
        own = attribute.values(structure)
        if attribute.domain == "EDGE":
            own = np.concatenate(
                [own, np.full(alone, -1 if attribute.field == "curve" else 0, np.int32)]
            )
        data.foreach_set(attribute.key, own)
    sharp = np.concatenate([structure.seam == SEAM, np.zeros(alone, bool)])
    if hasattr(mesh, "shade_smooth"):  # from 4.1
        mesh.shade_smooth()
    else:  # normals of corners, which auto smooth asks for, are half of Blender's evaluation
        mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
        mesh.use_auto_smooth, mesh.auto_smooth_angle = bool(sharp.any()), np.pi
    mesh.edges.foreach_set("use_edge_sharp", sharp)
    mesh.update()


def _shade_by_side(mesh: bpy.types.Mesh, corners: Ints) -> None:
    """Shade the smooth faces flat that the normal at a corner of theirs looks away from, which renders draw black.

    Smoothness ends at a flat face, so the normals next to it change; each round makes more faces flat, or is the last.
    """
    while True:
        smooth = _read(mesh.polygons, "use_smooth", np.bool_, 1)[:, 0]
        own = _read(mesh.polygons, "normal", np.float32, 3).repeat(corners, axis=0)
        away = np.einsum("ij,ij->i", own, _corner_normals(mesh)) <= 0.0
        seen = np.bincount(np.arange(len(corners)).repeat(corners)[away], minlength=len(corners))
        if not (smooth & (seen > 0)).any():
            return
        mesh.polygons.foreach_set("use_smooth", smooth & (seen == 0))
        mesh.update()


def _corner_normals(mesh: bpy.types.Mesh) -> NDArray[np.float32]:
    if hasattr(mesh, "corner_normals"):  # from 4.1
        return _read(mesh.corner_normals, "vector", np.float32, 3)
    mesh.calc_normals_split()
    found = _read(mesh.loops, "normal", np.float32, 3)
    mesh.free_normals_split()
    return found


def _read(elements: Any, name: str, kind: type, width: int) -> NDArray[Any]:
    values = np.empty(len(elements) * width, kind)
    elements.foreach_get(name, values)
    return values.reshape(-1, width)


def new_mesh(
    polygons: Polygons,
    name: str | bpy.types.Mesh,
    table: Iterable[Attribute] = (),
    edges: Ints | None = None,
    of_polygons: tuple[Ints, Ints] | None = None,
) -> bpy.types.Mesh:
    """A mesh of n-gons, flat shaded, with the attributes of a table, or no mesh at all.

    `name` is that of a new mesh, or a mesh that is emptied and filled again; it stays as it is where the coordinates
    are refused. `edges`, (w, 2) int32, come after those of the polygons. `of_polygons` are the edges of the polygons
    and the edge after each corner, where a thread has computed them. Raises InvalidInputError where coordinates are too
    large for Blender.
    """
    positions = _positions(polygons)
    _check_faces(polygons)
    mesh = bpy.data.meshes.new(name) if isinstance(name, str) else name
    mesh.clear_geometry()
    with _removed_on_error(mesh, name):
        alone = no_edges() if edges is None else edges
        _set_faces(mesh, polygons, positions, alone, of_polygons)
        _add_attributes(mesh, polygons, table)
    return mesh


@contextmanager
def _removed_on_error(mesh: bpy.types.Mesh, name: str | bpy.types.Mesh) -> Iterator[None]:
    """Remove a mesh that is new; empty one that was there before."""
    try:
        yield
    except BaseException:
        if isinstance(name, str):
            bpy.data.meshes.remove(mesh)
        else:
            mesh.clear_geometry()
        raise


def _add_attributes(mesh: bpy.types.Mesh, values: Any, table: Iterable[Attribute]) -> None:
    for attribute in table:
        data = mesh.attributes.new(attribute.name, attribute.type, attribute.domain).data
        own = attribute.values(values)
        if attribute.domain == "EDGE":  # those of polygons, which come first, have none
            own = np.concatenate([np.zeros(len(data) - len(own), own.dtype), own])
        data.foreach_set(attribute.key, own)


def _positions(polygons: Polygons) -> np.ndarray:
    with np.errstate(over="ignore"):
        positions = np.ascontiguousarray(polygons.vertices, np.float32).ravel()
    if not np.isfinite(positions).all():
        raise InvalidInputError(
            f"Expected coordinates below {np.finfo(np.float32).max:.3g}, which Blender can hold, "
            "found larger ones in the result; scale the object down, or choose side Inner"
        )
    return positions


def _check_faces(polygons: Polygons) -> None:
    """Blender trusts these arrays; a wrong index would end it.

    (`mesh.validate` takes longer than all the rest.)
    """
    corners = np.diff(polygons.face_offsets)
    inside = (polygons.face_vertices >= 0) & (polygons.face_vertices < len(polygons.vertices))
    whole = polygons.face_offsets[0] == 0 and polygons.face_offsets[-1] == len(
        polygons.face_vertices
    )
    if not (whole and inside.all() and corners.min(initial=3) >= 3):
        raise AssertionError("the arrays of a mesh contradict each other")


def _set_faces(
    mesh: bpy.types.Mesh,
    polygons: Polygons,
    positions: np.ndarray,
    alone: Ints,
    of_polygons: tuple[Ints, Ints] | None,
) -> None:
    """Set vertices, edges, corners and polygons.

    The edges are not made by Blender, because it takes several times as long for them, longer than for all the rest.

    Numbers that Blender keeps unsigned it copies in one go from unsigned arrays; others it reads one by one, which
    takes 20 times as long.
    """
    offsets = np.ascontiguousarray(polygons.face_offsets, np.uint32)
    edges, corner_edges = of_polygons or edges_of(
        polygons.face_offsets, polygons.face_vertices, len(polygons.vertices)
    )
    edges = np.concatenate([edges, alone])
    mesh.vertices.add(len(polygons.vertices))
    mesh.edges.add(len(edges))
    mesh.loops.add(len(polygons.face_vertices))
    mesh.polygons.add(len(offsets) - 1)
    mesh.polygons.foreach_set("loop_start", offsets[:-1])
    if bpy.app.version < (4, 1, 0):  # afterwards it follows from loop_start and cannot be written
        mesh.polygons.foreach_set("loop_total", np.diff(offsets))
    mesh.edges.foreach_set("vertices", edges.view(np.uint32).ravel())
    if ".corner_vert" in mesh.attributes:  # from 3.6 or so; then these alone are copied in one go
        attributes = mesh.attributes
        attributes["position"].data.foreach_set("vector", positions)
        attributes[".corner_vert"].data.foreach_set("value", polygons.face_vertices)
        attributes[".corner_edge"].data.foreach_set("value", corner_edges)
    else:
        mesh.vertices.foreach_set("co", positions)
        mesh.loops.foreach_set("vertex_index", polygons.face_vertices.view(np.uint32))
        mesh.loops.foreach_set("edge_index", corner_edges.view(np.uint32))
    mesh.update()
    if hasattr(mesh, "shade_flat"):  # from 4.1, where smooth is the default
        mesh.shade_flat()
