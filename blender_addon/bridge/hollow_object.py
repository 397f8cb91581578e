# SPDX-License-Identifier: GPL-3.0-or-later
"""Hollow solids as objects, with a drain hole that a Boolean modifier cuts with a cylinder, which can be moved."""

from __future__ import annotations

from functools import partial

import bpy
import numpy as np
from mathutils import Matrix

from ..core.arrays import Floats
from ..core.hollow.drain_hole import DrainHole, drain_hole
from ..core.hollow.hollow import Hollow
from .mesh import stored
from .mesh.write_mesh import new_mesh
from .objects.output_object import (
    Product,
    is_gone,
    new_object,
    place,
    remember,
    remove_object,
    replace_mesh,
    source_of,
)

_DRAIN = "Medial Axis Drain"  # the modifier
_AROUND = 48  # corners of the cylinder

HOLLOW = Product(" Hollow", (stored.HOLLOW_WALL,))


def unhollowed(thing: bpy.types.Object) -> bpy.types.Object:
    """The solid that was hollowed, as long as it is there; any other object is returned as it is."""
    source = source_of(thing) if HOLLOW.has(thing) else None
    return thing if source is None or is_gone(source) else source


def hole_of(found: Hollow, frame: Floats, width: float, at_cursor: bool) -> DrainHole:
    """The hole in a hollow solid, at its lowest place in the world or where its wall is nearest to the 3D cursor."""
    turned = frame[:3, :3].T
    down = turned @ (0.0, 0.0, -1.0)
    if not at_cursor:
        return drain_hole(found, width, down)
    cursor = np.array(bpy.context.scene.cursor.location)
    return drain_hole(found, width, down, turned @ (cursor - frame[:3, 3]))


def write_hollow(
    source: bpy.types.Object, found: Hollow, frame: Floats, hole: DrainHole | None
) -> bpy.types.Object:
    """Make the hollow solid of a source, or update the existing one."""
    thing, _ = HOLLOW.write_mesh(source, partial(new_mesh, found))
    place(thing, frame)
    remember(thing, source, found.points, found.duplicates, found.warnings)
    thing[stored.HOLLOW_WALL], thing[stored.HOLLOW_LEAST] = found.wall, found.least
    _write_drain(thing, hole)
    return thing


def _write_drain(thing: bpy.types.Object, hole: DrainHole | None) -> None:
    modifier = thing.modifiers.get(_DRAIN)
    if hole is None:
        if modifier is not None:
            _remove(modifier.object)
            thing.modifiers.remove(modifier)
        return
    if modifier is None:
        modifier = thing.modifiers.new(_DRAIN, "BOOLEAN")
        modifier.operation, modifier.solver = "DIFFERENCE", "EXACT"
    if modifier.object is None:
        modifier.object = new_object(thing, " Drain", _cylinder(hole, thing.name + " Drain"))
    else:
        replace_mesh(modifier.object, partial(_cylinder, hole))
    cutter = modifier.object
    cutter.display_type, cutter.hide_render = "WIRE", True
    cutter.parent, cutter.matrix_parent_inverse = thing, Matrix.Identity(4)
    cutter.matrix_basis = Matrix.Translation(hole.start.tolist())


def _remove(cutter: bpy.types.Object | None) -> None:
    if cutter is not None:
        remove_object(cutter)


def _cylinder(hole: DrainHole, name: str) -> bpy.types.Mesh:
    """A prism from the origin to where the hole ends."""
    along = hole.end - hole.start
    aside = np.cross(along, np.identity(3)[np.argmin(np.abs(along))])
    aside /= np.linalg.norm(aside)
    up = np.cross(along, aside) / np.linalg.norm(along)
    turn = 2.0 * np.pi * np.arange(_AROUND) / _AROUND
    ring = 0.5 * hole.width * (np.cos(turn)[:, None] * aside + np.sin(turn)[:, None] * up)
    i = np.arange(_AROUND)
    sides = np.column_stack((i, np.roll(i, -1), np.roll(i, -1) + _AROUND, i + _AROUND))
    faces = [*sides.tolist(), i[::-1].tolist(), (i + _AROUND).tolist()]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.concatenate((ring, ring + along)).tolist(), [], faces)
    return mesh
