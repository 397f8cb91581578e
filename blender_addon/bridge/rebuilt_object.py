# SPDX-License-Identifier: GPL-3.0-or-later
"""The solid of a medial axis as an object: the mesh of the axis under the modifier *Rebuild*, so it is live.

It shares its mesh with the result, and so follows a new computation. How far it is from what the axis was computed of
is measured and remembered.
"""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from ..core.axis.colours import radius_range as colours_of_radii
from ..core.errors import InvalidInputError
from ..core.rebuild.solid_difference import SolidDifference, solid_difference
from ..core.settings import Side
from ..core.shape.shape import Shape
from ..core.small_matrices import inverse, times
from .axis.axis_object import radius_range, settings_of
from .mesh import stored
from .mesh.colours import remember_colours
from .mesh.material import FLAT
from .nodes.groups import add_modifier, is_group
from .objects.output_object import Product, follow_like, is_gone, new_object, source_of
from .objects.read_object import read_object

SOLID = Product(" Rebuilt", (stored.REBUILT,))
is_rebuilt, rebuilt_of = SOLID.has, SOLID.of


def unrebuilt(thing: bpy.types.Object | None) -> bpy.types.Object | None:
    """The axis from which a solid was rebuilt; any other object is returned as it is."""
    return source_of(thing) if thing is not None and is_rebuilt(thing) else thing


def modifier_of(rebuilt: bpy.types.Object) -> bpy.types.NodesModifier | None:
    """The modifier that makes the solid; None when someone has removed it."""
    found = (
        m for m in rebuilt.modifiers if m.type == "NODES" and is_group(m.node_group, "REBUILD")
    )
    return next(found, None)


def rebuild(result: bpy.types.Object) -> bpy.types.Object:
    """The solid of a result: the existing one, or a new one.

    Raises InvalidInputError where the axis is not of the inside.
    """
    side = settings_of(result).side
    if side is not Side.INNER:
        raise InvalidInputError(
            f"Expected a medial axis of the inside, found side {side.name.title()}; compute it with side Inner"
        )
    found = rebuilt_of(result)
    if found is not None:
        return found
    made = new_object(result, SOLID.suffix, result.data)
    follow_like(made, result)
    made[stored.REBUILT], made[stored.SOURCE] = True, result
    made.color = FLAT
    start, end = colours_of_radii(radius_range(result))
    remember_colours(made, result.get(stored.COLOUR_OF, ""), start, end)
    add_modifier(made, "REBUILD")
    return made


def measure(rebuilt: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> SolidDifference | None:
    """Measures and remembers how far the solid is from the source of its axis; None when that source is gone.

    Raises InvalidInputError where one of the two has no faces, NativeModuleError and OutOfMemoryError.
    """
    result = source_of(rebuilt)
    source = None if is_gone(result) else source_of(result)
    if is_gone(source):
        return None
    shapes = [_in_the_world(read_object(thing, depsgraph)) for thing in (source, rebuilt)]
    found = solid_difference(*shapes)
    rebuilt[stored.REBUILT_MEAN], rebuilt[stored.REBUILT_LARGEST] = found.mean, found.largest
    rebuilt[stored.REBUILT_VOLUME] = found.volume
    return found


def in_frame_of(shape: Shape, thing: bpy.types.Object) -> Shape:
    """A shape as seen from an object."""
    world, frame = _in_the_world(shape), np.array(thing.matrix_world, np.float64)
    return replace(world, points=times(world.points - frame[:3, 3], inverse(frame[:3, :3])))


def _in_the_world(shape: Shape) -> Shape:
    frame = shape.frame
    return replace(shape, points=times(shape.points, frame[:3, :3]) + frame[:3, 3])
