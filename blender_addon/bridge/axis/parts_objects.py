# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheets of an axis: selected on it, or as objects of their own in a collection."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from ... import __version__
from ...core.arrays import Floats, Ints
from ...core.axis.medial_axis import MedialAxis
from ...core.axis.turning import with_facets_turned
from ...core.errors import InvalidInputError
from ..mesh import stored
from ..mesh.attributes import PART, RADIUS, Attribute, read_attribute
from ..mesh.colours import remember_colours
from ..mesh.mesh_arrays import select_faces, selected_faces
from ..mesh.write_mesh import new_mesh
from ..objects.output_object import collection_of, is_gone, remove_object
from .read_axis import read_axis

MOST = 1000  # objects


def part_of_active_face(thing: bpy.types.Object) -> int:
    """The part of the active face of an axis in edit mode; 0 without one."""
    thing.update_from_editmode()
    mesh = thing.data.copy()  # in edit mode Blender shows no values of attributes
    try:
        part, active = _parts(mesh), mesh.polygons.active
        return int(part[active]) if 0 <= active < len(part) else 0
    finally:
        bpy.data.meshes.remove(mesh)


def select_part(thing: bpy.types.Object, number: int, extend: bool) -> int:
    """Select the faces of a part of an axis in object mode, with `extend` besides what is selected; returns how many
    there are.
    """
    mesh = thing.data
    wanted = _parts(mesh) == number
    if extend:
        wanted |= selected_faces(mesh)
    select_faces(mesh, wanted)
    return int(np.count_nonzero(_parts(mesh) == number))


def _parts(mesh: bpy.types.Mesh) -> Ints:
    part = read_attribute(mesh.attributes, PART.name, PART.type, PART.domain)
    return np.full(len(mesh.polygons), -1, np.int32) if part is None else part


@dataclass(frozen=True, eq=False)
class _Sheet:
    """The facets of one part as polygons with values."""

    vertices: Floats
    face_offsets: Ints
    face_vertices: Ints
    radius: Floats
    part: Ints


_TABLE: tuple[Attribute, ...] = (RADIUS, PART)


def separate_parts(result: bpy.types.Object) -> bpy.types.Collection:
    """Make an object of each part of an axis, in a collection next to it; those that were made before are replaced.

    Raises InvalidInputError where the axis has no parts, or more than Blender shows well as objects.
    """
    axis = with_agreeing_facets(read_axis(result))
    sheets = [_sheet(axis, number) for number in range(axis.structure.parts)]
    collection = collection_of({stored.SOURCE: result}, f"{result.name} Parts", result)
    for thing in [
        t for t in collection.objects if t.get(stored.SOURCE) == result and stored.PART_NUMBER in t
    ]:
        remove_object(thing)
    for number, sheet in enumerate(sheets):
        _add_object(collection, result, sheet, number)
    return collection


def with_agreeing_facets(axis: MedialAxis) -> MedialAxis:
    """The axis with the facets of each part turned alike."""
    structure = axis.structure
    if structure is None:
        raise InvalidInputError(
            "Expected a medial axis with parts, found one without; compute the form Clean again"
        )
    if structure.parts > MOST:
        raise InvalidInputError(
            f"Expected at most {MOST:,} parts, found {structure.parts:,}; raise Simplify, or use the "
            "attribute ma_part"
        )
    return with_facets_turned(axis, structure.turned)


def _sheet(axis: MedialAxis, number: int) -> _Sheet:
    keep = axis.structure.part == number
    sizes = np.diff(axis.face_offsets)
    corners = axis.face_vertices[np.repeat(keep, sizes)]
    used, rows = np.unique(corners, return_inverse=True)
    offsets = np.concatenate([[0], np.cumsum(sizes[keep])]).astype(np.int32)
    part = np.full(len(offsets) - 1, number, np.int32)
    return _Sheet(
        axis.vertices[used], offsets, rows.ravel().astype(np.int32), axis.radius[used], part
    )


def _add_object(
    collection: bpy.types.Collection, result: bpy.types.Object, sheet: _Sheet, number: int
) -> None:
    name = f"{result.name} Part {number}"
    mesh = new_mesh(sheet, name, _TABLE)
    mesh.polygons.foreach_set("use_smooth", np.ones(len(mesh.polygons), bool))
    for material in result.data.materials:
        mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    thing.matrix_world = result.matrix_world
    thing[stored.SOURCE], thing[stored.VERSION], thing[stored.PART_NUMBER] = (
        result,
        __version__,
        number,
    )
    thing.show_in_front, thing.color = result.show_in_front, result.color
    remember_colours(
        thing, "", result.get(stored.COLOUR_START, 0.0), result.get(stored.COLOUR_END, 0.0)
    )
    collection.objects.link(thing)


def parts_of(result: bpy.types.Object) -> list[bpy.types.Object]:
    """The objects that were made of the parts of a result."""
    return [
        t
        for t in bpy.data.objects
        if stored.PART_NUMBER in t and t.get(stored.SOURCE) == result and not is_gone(t)
    ]
