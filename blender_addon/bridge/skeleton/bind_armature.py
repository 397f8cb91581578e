# SPDX-License-Identifier: GPL-3.0-or-later
"""How a mesh is bound to an armature: vertex groups with the weights of the axis or of Blender, and a modifier."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

from ...core.errors import InvalidInputError
from ...core.rig.rig import Rig
from ..mesh import stored
from ..objects.output_object import inverse_of
from .armature_object import active, bones_of, mark_of, rig_of
from .skeleton_object import rows_of_vertices

MODIFIER = "Medial Axis Armature"


def check_bindable(source: bpy.types.Object, bind: bool, replace_weights: bool = False) -> None:
    """Raise InvalidInputError when an armature cannot be made now, or the source not be bound to it.

    `bind` says whether the source gets weights, and `replace_weights` whether weights may go that were painted since
    the last time.
    """
    if bpy.context.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected object mode, found '{bpy.context.object.name}' in another one; leave that mode"
        )
    if bind and (source.type != "MESH" or source.data.library is not None):
        raise InvalidInputError(
            f"Expected a mesh of this file to bind, found '{source.name}', which is not; choose Weights None"
        )
    if bind and not 0.0 < abs(source.matrix_world.determinant()) < float("inf"):
        raise InvalidInputError(
            f"Expected a scale that Blender can invert, found one too large or too small of '{source.name}'; "
            "apply the scale, or choose Weights None"
        )
    made = rig_of(source)
    if bind and not replace_weights and made is not None and _is_painted(source, made):
        raise InvalidInputError(
            f"Expected the weights of '{source.name}' as they were made, found some painted since; "
            "choose Weights None to keep them, or Replace Weights"
        )


def groups_of_others(source: bpy.types.Object) -> set[str]:
    """The vertex groups of a source that were not made for its armature, by name; it marks older ones on the way."""
    made = rig_of(source)
    if made is None:
        return _names(source)
    _mark_older(source, made)
    _set_groups(source, made, _own_groups(source, made))
    return _names(source) - set(_own_groups(source, made))


def bind_by_axis(source: bpy.types.Object, armature: bpy.types.Object, rig: Rig) -> None:
    """Weights of the axis, as vertex groups; a modifier; and the armature as parent."""
    _forget_groups(source, armature)
    groups = [source.vertex_groups.new(name=name) for name in bones_of(armature, source, rig)]
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
    _remember_groups(source, armature, [group.name for group in groups])
    _attach(source, armature)


def bind_by_heat(source: bpy.types.Object, armature: bpy.types.Object, rig: Rig) -> bool:
    """Blender's automatic weights. Whether every vertex got one; if not, nothing is bound."""
    _forget_groups(source, armature)
    kept, before = list(source.modifiers), _names(source)
    parent = source.parent, source.parent_type, source.parent_bone
    inverse, world = source.matrix_parent_inverse.copy(), source.matrix_world.copy()
    with active(armature), _alone(armature, set(bones_of(armature, source, rig))):
        source.select_set(True)
        bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    source.parent, source.parent_type, source.parent_bone = parent
    source.matrix_parent_inverse, source.matrix_world = inverse, world
    for modifier in [m for m in source.modifiers if m not in kept]:
        source.modifiers.remove(modifier)
    made = sorted(_names(source) - before)
    _remember_groups(source, armature, made)
    numbers = {source.vertex_groups[name].index for name in made}
    if any(numbers.isdisjoint(g.group for g in v.groups) for v in source.data.vertices):
        _forget_groups(source, armature)
        return False
    _attach(source, armature)
    return True


@contextmanager
def _alone(armature: bpy.types.Object, names: set[str]) -> Iterator[None]:
    """Only these bones deform; then again all that did before."""
    others = [bone for bone in armature.data.bones if bone.use_deform and bone.name not in names]
    for bone in others:
        bone.use_deform = False
    try:
        yield
    finally:
        for bone in others:
            bone.use_deform = True


def _attach(source: bpy.types.Object, armature: bpy.types.Object) -> None:
    """The armature as modifier and parent; the source stays where it is.

    What an artist hung the source on stays its parent, and becomes that of the armature.
    """
    bound = [m for m in source.modifiers if m.type == "ARMATURE" and m.object == armature]
    if not bound:
        source.modifiers.new(MODIFIER, "ARMATURE").object = armature
    if source.parent in (None, armature):
        child, parent = source, armature
        kind, bone = "OBJECT", ""
    else:
        child, parent = armature, source.parent
        kind, bone = source.parent_type, source.parent_bone
    world = child.matrix_world.copy()
    child.parent, child.parent_type, child.parent_bone = parent, kind, bone
    child.matrix_parent_inverse = inverse_of(parent.matrix_world)
    child.matrix_world = world


def _mark_older(source: bpy.types.Object, armature: bpy.types.Object) -> None:
    """Mark the bones and groups of an armature from before they were marked: all of its bones were made here."""
    bones = armature.data.bones
    if (
        mark_of(armature, source) == ""
        and len(bones)
        and not any(stored.MADE_BONE in bone for bone in bones)
    ):
        for bone in bones:
            bone[stored.MADE_BONE] = bone.name
        _set_groups(source, armature, [bone.name for bone in bones])


def _names(source: bpy.types.Object) -> set[str]:
    return {group.name for group in source.vertex_groups}


def _own_groups(source: bpy.types.Object, armature: bpy.types.Object) -> list[str]:
    """The vertex groups that were made for this armature, by the names that they have now."""
    mark = mark_of(armature, source) or ""
    bones = [bone for bone in armature.data.bones if stored.BONE_GROUP + mark in bone]
    now = {bone[stored.BONE_GROUP + mark]: bone.name for bone in bones}
    return [
        now.get(name, name) for name in armature.get(stored.BOUND_GROUPS + mark, "").splitlines()
    ]


def _set_groups(source: bpy.types.Object, armature: bpy.types.Object, names: list[str]) -> None:
    mark = mark_of(armature, source) or ""
    armature[stored.BOUND_GROUPS + mark] = "\n".join(names)
    for bone in armature.data.bones:
        if bone.name in names:
            bone[stored.BONE_GROUP + mark] = bone.name


def _remember_groups(
    source: bpy.types.Object, armature: bpy.types.Object, names: list[str]
) -> None:
    _set_groups(source, armature, names)
    armature[stored.BOUND_WEIGHTS + (mark_of(armature, source) or "")] = _hash_of_weights(
        source, names
    )


def _forget_groups(source: bpy.types.Object, armature: bpy.types.Object) -> None:
    """Remove the vertex groups that were made for this armature before."""
    for name in _own_groups(source, armature):
        if group := source.vertex_groups.get(name):
            source.vertex_groups.remove(group)
    _set_groups(source, armature, [])


def _is_painted(source: bpy.types.Object, armature: bpy.types.Object) -> bool:
    """Return whether someone changed the weights since they were made; groups that are gone have nothing to lose."""
    names = _own_groups(source, armature)
    key = stored.BOUND_WEIGHTS + (mark_of(armature, source) or "")
    if _names(source).isdisjoint(names) or key not in armature:
        return False
    return armature[key] != _hash_of_weights(source, names)


def _hash_of_weights(source: bpy.types.Object, names: list[str]) -> str:
    """A hash of the weights in some groups, whatever these are called."""
    place = {name: number for number, name in enumerate(names)}
    column = {group.index: place.get(group.name) for group in source.vertex_groups}
    digest = hashlib.blake2b(digest_size=16)
    for vertex in source.data.vertices:
        rows = ((column[g.group], g.weight) for g in vertex.groups)
        digest.update(repr(sorted(row for row in rows if row[0] is not None)).encode())
    return digest.hexdigest()
