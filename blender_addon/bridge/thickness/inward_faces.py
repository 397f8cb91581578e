# SPDX-License-Identifier: GPL-3.0-or-later
"""Faces of a mesh that look inward, which computations read the other way round: selected, or turned in the mesh."""

from __future__ import annotations

import bpy
import numpy as np

from ...core.arrays import Flags
from ...core.shape.outward_faces import outward_shape
from ...core.shape.shape import TURNED, Shape
from ..mesh.mesh_arrays import read_loop_triangles, read_positions, select_faces
from .thin_selection import in_object_mode


def select_inward(thing: bpy.types.Object) -> int:
    """Select the faces of a mesh that look inward, and nothing else; returns how many there are.

    Raises InvalidInputError where a coordinate is not finite.
    """
    with in_object_mode(thing):
        wanted = inward_polygons(thing.data)
        select_faces(thing.data, wanted)
    return int(np.count_nonzero(wanted))


def turn_inward(thing: bpy.types.Object) -> int:
    """Turn the faces of a mesh that look inward; returns how many there were.

    Raises InvalidInputError where a coordinate is not finite.
    """
    with in_object_mode(thing):
        rows = np.flatnonzero(inward_polygons(thing.data)).tolist()
        polygons = thing.data.polygons
        for row in rows:
            polygons[row].flip()
        thing.data.update()
    return len(rows)


def inward_polygons(mesh: bpy.types.Mesh) -> Flags:
    """Return the polygons that rays call turned, (p,), without modifiers."""
    triangles, polygons = read_loop_triangles(mesh)
    inward = np.zeros(len(mesh.polygons), bool)
    reading = outward_shape(Shape(read_positions(mesh), triangles)).reading
    if reading is not None:
        inward[polygons[reading == TURNED]] = True
    return inward
