# SPDX-License-Identifier: GPL-3.0-or-later
"""Armatures along skeletons: how they are found, made and updated, and how a mesh is bound to them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.errors import InvalidInputError
from .output_object import Product, new_object, place, remember
from .skeleton_object import rows_of_vertices

if TYPE_CHECKING:
    from ..core.skeleton.rig import Rig

BONES = "ma_bones"
MODIFIER = "Medial Axis Armature"


ARMATURE = Product(" Armature", (BONES,), type="ARMATURE")
is_armature, armature_of = ARMATURE.has, ARMATURE.of


def check_armature_writable(source: bpy.types.Object, bind: bool) -> None:
    """Raise InvalidInputError when an armature cannot be made now, or the source not be bound to it."""
    if bpy.context.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected object mode, found '{bpy.context.object.name}' in another one; leave that mode"
        )
    if bind and (source.type != "MESH" or source.data.library is not None):
        raise InvalidInputError(
            f"Expected a mesh of this file to bind, found '{source.name}', which is not; choose Bind None"
        )


def write_armature(source: bpy.types.Object, rig: Rig, frame: np.ndarray) -> bpy.types.Object:
    """Make the armature of a source, or give the one there is other bones; the source is not bound to it.

    Parameters
    ----------
    source : Object
    rig : Rig
    frame : (4, 4) float64
        Where the bones lie in the world; rotation and translation only.
    """
    thing = armature_of(source)
    if thing is None:
        thing = new_object(
            source, ARMATURE.suffix, bpy.data.armatures.new(source.name + ARMATURE.suffix)
        )
        thing.show_in_front = True
    place(thing, frame)
    bpy.context.view_layer.update()
    with _active(thing):
        bpy.ops.object.mode_set(mode="EDIT")
        try:
            _fill(thing.data, rig)
        finally:
            bpy.ops.object.mode_set(mode="OBJECT")
    remember(thing, source, rig.made_of.points, rig.made_of.duplicates, rig.warnings)
    thing[BONES] = rig.bones.count
    return thing


def bind_by_axis(source: bpy.types.Object, armature: bpy.types.Object, rig: Rig) -> None:
    """Weights of the axis, as vertex groups; a modifier; and the armature as parent."""
    _forget_groups(source, rig)
    groups = [source.vertex_groups.new(name=name) for name in rig.names]
    rows = rows_of_vertices(source, rig.made_of.shape)
    bone, weight = rig.bone[rows], rig.weight[rows]
    order = np.argsort(bone, axis=None, kind="stable")
    for vertex, group, value in zip(
        (order // bone.shape[1]).tolist(),
        bone.ravel()[order].tolist(),
        weight.ravel()[order].tolist(),
        strict=True,
    ):
        if value > 0.0:
            groups[group].add((vertex,), value, "REPLACE")
    _attach(source, armature)


def bind_by_heat(source: bpy.types.Object, armature: bpy.types.Object, rig: Rig) -> bool:
    """Blender's automatic weights. Whether every vertex got one; if not, nothing is bound."""
    _forget_groups(source, rig)
    kept = list(source.modifiers)
    with _active(armature):
        source.select_set(True)
        bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    for modifier in [m for m in source.modifiers if m not in kept]:
        source.modifiers.remove(modifier)
    if any(not vertex.groups for vertex in source.data.vertices):
        _forget_groups(source, rig)
        return False
    _attach(source, armature)
    return True


def _fill(armature: bpy.types.Armature, rig: Rig) -> None:
    bones, made = rig.bones, []
    for old in list(armature.edit_bones):
        armature.edit_bones.remove(old)
    for number, name in enumerate(rig.names):
        bone = armature.edit_bones.new(name)
        bone.head, bone.tail = bones.head[number].tolist(), bones.tail[number].tolist()
        bone.head_radius = float(bones.head_radius[number])
        bone.tail_radius = float(bones.tail_radius[number])
        if bones.parent[number] >= 0:
            bone.parent, bone.use_connect = made[bones.parent[number]], True
        made.append(bone)


def _attach(source: bpy.types.Object, armature: bpy.types.Object) -> None:
    """The armature as modifier and parent; the source stays where it is."""
    modifier = source.modifiers.get(MODIFIER) or source.modifiers.new(MODIFIER, "ARMATURE")
    modifier.object = armature
    world = source.matrix_world.copy()
    source.parent, source.parent_type = armature, "OBJECT"
    source.matrix_parent_inverse = armature.matrix_world.inverted()
    source.matrix_world = world


def _forget_groups(source: bpy.types.Object, rig: Rig) -> None:
    """Remove the vertex groups of bones of these names, and of an armature that was bound before."""
    modifier = source.modifiers.get(MODIFIER)
    old = modifier.object.data.bones.keys() if modifier and modifier.object else ()
    for name in {*rig.names, *old}:
        if group := source.vertex_groups.get(name):
            source.vertex_groups.remove(group)


@contextmanager
def _active(thing: bpy.types.Object) -> Iterator[None]:
    """One object active and selected alone, as Blender's operators want it; then as it was."""
    layer = bpy.context.view_layer
    active, selected = layer.objects.active, list(bpy.context.selected_objects)
    for other in selected:
        other.select_set(False)
    layer.objects.active = thing
    thing.select_set(True)
    try:
        yield
    finally:
        thing.select_set(False)
        layer.objects.active = active
        for other in selected:
            other.select_set(True)
