# SPDX-License-Identifier: GPL-3.0-or-later
"""Thicker walls on the artist's own mesh: the moves of its vertices as an attribute, a modifier that applies them, and
a vertex group of where they are."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Flags, Floats
from ...core.errors import InvalidInputError
from ...core.small_matrices import inverse, times
from ..mesh import stored
from ..mesh.attributes import as_float32, read_vectors, set_attribute
from ..mesh.evaluated_rows import keeps_rows
from ..mesh.mesh_arrays import read_loop_triangles, selected_faces
from ..mesh.step_weights import write_steps
from ..nodes.groups import add_modifier, is_group
from ..nodes.inputs import input_of, set_inputs
from ..nodes.thicken import MOVES
from ..objects.output_object import check_mode
from ..objects.read_object import split_transform

_GROUP = "Medial Axis Thicken"
_FACTOR = "Factor"


def check_thickenable(source: bpy.types.Object) -> None:
    """Raise InvalidInputError when the vertices of a source cannot get moves now."""
    if source.type != "MESH" or source.data.library is not None:
        raise InvalidInputError(
            "Expected a mesh of this file, whose own vertices can be moved, found another object; convert it to a mesh"
        )
    check_mode(source)
    if not keeps_rows(source):
        raise InvalidInputError(
            "Expected modifiers that keep the vertices and faces of the mesh, found some that make others; apply them "
            "first"
        )


def reserve_moves(source: bpy.types.Object) -> None:
    """Give a mesh the attribute of its moves where it has none, so that nothing else fails after its faces are divided.

    Raises InvalidInputError where something else has its name.
    """
    if thicken_modifier(source) is None:
        none = np.zeros(3 * len(source.data.vertices), np.float32)
        set_attribute(source.data, MOVES, "FLOAT_VECTOR", "POINT", none)


def write_moves(source: bpy.types.Object, moves: Floats) -> None:
    """Give a source the moves, (v, 3) in the frame of its shape, where its scale is applied, on top of those that its
    modifier applies already.
    """
    _, rest = split_transform(np.array(source.matrix_world, np.float64))
    local = times(moves, inverse(rest))
    modifier = thicken_modifier(source)
    if modifier is not None and modifier.show_viewport:
        local += input_of(modifier, _FACTOR) * read_vectors(
            source.data.attributes[MOVES].data, "vector"
        )
    set_attribute(source.data, MOVES, "FLOAT_VECTOR", "POINT", as_float32(local).ravel())
    if modifier is None:
        modifier = add_modifier(source, "THICKEN")
    modifier.show_viewport = True
    set_inputs(modifier, {_FACTOR: 1.0})
    lengths = np.linalg.norm(local, axis=1)
    write_steps(source, _own_group(source), lengths / (lengths.max(initial=0.0) or 1.0))
    source.data.update()


def _own_group(source: bpy.types.Object) -> str:
    """The name of the vertex group that was made here; one of the artist's that has our name stays as it is."""
    name = source.get(stored.THICKEN_GROUP)
    if not isinstance(name, str) or name not in source.vertex_groups:
        name = source[stored.THICKEN_GROUP] = source.vertex_groups.new(name=_GROUP).name
    return name


def thicken_modifier(source: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """The modifier that moves the walls of a source and still finds how far; else None."""
    for modifier in source.modifiers:
        is_ours = modifier.type == "NODES" and is_group(modifier.node_group, "THICKEN")
        if is_ours and MOVES in source.data.attributes:
            return modifier
    return None


def selected_triangles(source: bpy.types.Object) -> Flags:
    """Return which of a mesh's triangles belong to faces that are selected in edit mode, (m,)."""
    _, polygons = read_loop_triangles(source.data)
    return selected_faces(source.data)[polygons]
