# SPDX-License-Identifier: GPL-3.0-or-later
"""A result object -> the medial axis that it holds, in the object's own frame."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.arrays import Floats, Ints
from ...core.axis.medial_axis import LevelValues, MedialAxis
from ...core.axis.turning import with_facets_turned
from ...core.errors import InvalidInputError
from ..mesh import stored
from ..mesh.attributes import LEVEL_ATTRIBUTES, Attribute, attributes, read_attribute
from ..mesh.mesh_arrays import read_corner_edges, read_edges, read_polygons, read_positions
from ..objects.output_object import is_gone
from .axis_object import is_result, result_of
from .reduced_object import is_reduced
from .structure_object import read_structure


def find_axis(thing: bpy.types.Object | None) -> bpy.types.Object | None:
    """The result or small medial mesh that `thing` is, or the result that was computed from it; None without either."""
    if is_gone(thing):
        return None
    return thing if is_result(thing) or is_reduced(thing) else result_of(thing)


def read_axis(result: bpy.types.Object) -> MedialAxis:
    """Read a medial axis back from a mesh and its attributes, as it is now: an artist may have edited it.

    Raises InvalidInputError where an attribute of the table is missing.
    """
    with _readable_mesh(result) as mesh:
        offsets, corners = read_polygons(mesh)
        vertices = read_positions(mesh)
        edges, alone = _edges_alone(mesh)
        fields = _fields(mesh, attributes(), result.name)
        level = _level(mesh, alone, result)
        structure = read_structure(mesh, alone, result, fields["generators"])
    turned = fields["generators"][:, 0] > fields["generators"][:, 1]
    axis = MedialAxis(
        vertices=vertices,
        face_offsets=offsets,
        face_vertices=corners,
        unbounded=int(result.get(stored.UNBOUNDED, 0)),
        zero_area=int(result.get(stored.ZERO_AREA, 0)),
        edges=edges,
        level=level,
        structure=structure,
        **fields,
    )
    return with_facets_turned(axis, turned) if turned.any() else axis


def world_matrix(result: bpy.types.Object) -> Floats:
    """Return where the object lies in the world, (4, 4)."""
    return np.array(result.matrix_world, np.float64)


@contextmanager
def _readable_mesh(result: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """The mesh of the object; in edit mode a copy, for there Blender shows no attribute values."""
    if not result.data.is_editmode:
        yield result.data
        return
    result.update_from_editmode()
    mesh = result.data.copy()
    try:
        yield mesh
    finally:
        bpy.data.meshes.remove(mesh)


def _edges_alone(mesh: bpy.types.Mesh) -> tuple[Ints, NDArray[np.intp]]:
    """Return (w, 2) the ends of the edges without a face, and (w,) which edges these are."""
    alone = np.ones(len(mesh.edges), bool)
    alone[read_corner_edges(mesh)] = False
    return read_edges(mesh)[alone], np.flatnonzero(alone)


def _level(
    mesh: bpy.types.Mesh, alone: NDArray[np.intp], result: bpy.types.Object
) -> LevelValues | None:
    """The level of a clean form or a curve; None for an axis as published."""
    if stored.BETTI not in result:
        return None
    fields = _fields(mesh, LEVEL_ATTRIBUTES, result.name)
    fields["limb"] = fields["limb"][alone]
    pieces, loops, cavities = result[stored.BETTI]
    return LevelValues(betti=(pieces, loops, cavities), **fields)


def _fields(mesh: bpy.types.Mesh, table: tuple[Attribute, ...], name: str) -> dict[str, NDArray]:
    """The fields that are stored as the attributes of a table; `name` is for messages."""
    columns: dict[str, list[NDArray]] = {}
    for attribute in table:
        columns.setdefault(attribute.field, []).append(_values(mesh, attribute, name))
    return {
        field: np.column_stack(parts) if len(parts) > 1 else parts[0]
        for field, parts in columns.items()
    }


def _values(mesh: bpy.types.Mesh, attribute: Attribute, name: str) -> NDArray:
    values = read_attribute(mesh.attributes, attribute.name, attribute.type, attribute.domain)
    if values is None:
        raise InvalidInputError(
            f"Expected the {attribute.domain.lower()} attribute '{attribute.name}' on '{name}', "
            "found none; compute the medial axis again"
        )
    return values.astype(np.float64) if attribute.dtype == np.float32 else values
