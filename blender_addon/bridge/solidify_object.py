# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids of sheets as objects, with the wall at each vertex as an attribute."""

from __future__ import annotations

from functools import partial

import bpy
import numpy as np

from ..core.arrays import Flags, Floats
from ..core.errors import InvalidInputError
from ..core.solidify.solidify import Solidified
from .mesh import stored
from .mesh.attributes import Attribute
from .mesh.evaluated_rows import keeps_rows
from .mesh.write_mesh import new_mesh
from .objects.output_object import Product, place, remember
from .thickness.thicken_modifier import selected_triangles

_TABLE = (Attribute("ma_wall", "walls", "POINT", "FLOAT", np.float32),)

SOLID = Product(" Solid", (stored.SOLID_WALL,))


def chosen_triangles(source: bpy.types.Object) -> Flags:
    """Return which triangles of a source belong to selected faces, (m,).

    Raises InvalidInputError where its modifiers make other faces than those that can be selected, or it has none.
    """
    if source.type != "MESH" or not keeps_rows(source):
        raise InvalidInputError(
            "Expected a mesh whose modifiers keep its faces, found other faces than can be selected; apply the "
            "modifiers, or switch Selected Faces off"
        )
    return selected_triangles(source)


def write_solid(source: bpy.types.Object, found: Solidified, frame: Floats) -> bpy.types.Object:
    """Make the solid of a source, or update the existing one."""
    thing, _ = SOLID.write_mesh(source, partial(new_mesh, found, table=_TABLE))
    place(thing, frame)
    remember(thing, source, found.points, found.duplicates, found.warnings)
    thing[stored.SOLID_WALL], thing[stored.SOLID_LEAST] = found.wall, found.least
    return thing
