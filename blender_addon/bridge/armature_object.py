# SPDX-License-Identifier: GPL-3.0-or-later
"""Armatures along skeletons: how they are found, made and updated, and how a mesh is bound to them."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.errors import InvalidInputError
from .output_object import Product, inverse_of, new_object, place, remember
from .skeleton_object import rows_of_vertices

if TYPE_CHECKING:
    from ..core.skeleton.rig import Rig

_SHORTEST = 1e-6  # Blender deletes shorter bones

BONES = "ma_bones"
MODIFIER = "Medial Axis Armature"
_MADE = "ma_bone"  # on each bone that was made here: the name that it got then, which an artist may change
_GROUPS = "ma_groups"  # the vertex groups that were made here, a name per line
_GROUP = (
    "ma_group"  # on a bone: the name of its group there; Blender renames groups with their bones
)
_WEIGHTS = "ma_weights"  # a hash of the weights in them


ARMATURE = Product(" Armature", (BONES,), type="ARMATURE")
is_armature, armature_of = ARMATURE.has, ARMATURE.of


def check_armature_writable(
    source: bpy.types.Object, bind: bool, replace_weights: bool = False
) -> None:
    """Raise InvalidInputError when an armature cannot be made now, or the source not be bound to it.

    Parameters
    ----------
    source : Object
    bind : bool
        Whether the source gets weights.
    replace_weights : bool
        Whether weights may go that were painted since the last time.
    """
    if bpy.context.mode != "OBJECT":
        raise InvalidInputError(
            f"Expected object mode, found '{bpy.context.object.name}' in another one; leave that mode"
        )
    if bind and (source.type != "MESH" or source.data.library is not None):
        raise InvalidInputError(
            f"Expected a mesh of this file to bind, found '{source.name}', which is not; choose Bind None"
        )
    if bind and not 0.0 < abs(source.matrix_world.determinant()) < float("inf"):
        raise InvalidInputError(
            f"Expected a scale that Blender can invert, found one too large or too small of '{source.name}'; "
            "apply the scale, or choose Bind None"
        )
    made = armature_of(source)
    if bind and not replace_weights and made is not None and _is_painted(source, made):
        raise InvalidInputError(
            f"Expected the weights of '{source.name}' as they were made, found some painted since; "
            "choose Bind None to keep them, or Replace Weights"
        )


@contextmanager
def in_rest(source: bpy.types.Object) -> Iterator[None]:
    """The source without the modifier that binds it to its armature, so that it is read as it is at rest."""
    made = armature_of(source)
    bound = [m for m in source.modifiers if m.type == "ARMATURE" and made and m.object == made]
    shown = [modifier.show_viewport for modifier in bound]
    for modifier in bound:
        modifier.show_viewport = False
    if any(shown):
        bpy.context.view_layer.update()
    try:
        yield
    finally:
        for modifier, was in zip(bound, shown, strict=True):
            modifier.show_viewport = was
        if any(shown):
            bpy.context.view_layer.update()


def write_armature(source: bpy.types.Object, rig: Rig, frame: np.ndarray) -> bpy.types.Object:
    """Make the armature of a source, or give the existing one other bones; the source is not bound to it.

    Bones that an artist added stay, with their constraints, and so do the pose and the names that he gave to others.

    Parameters
    ----------
    source : Object
    rig : Rig
    frame : (4, 4) float64
        Where the bones lie in the world; rotation and translation only.
    """
    _check_lengths(rig)
    thing = armature_of(source)
    if thing is None:
        thing = new_object(
            source, ARMATURE.suffix, bpy.data.armatures.new(source.name + ARMATURE.suffix)
        )
        thing.show_in_front = True
    place(thing, frame)
    bpy.context.view_layer.update()
    _mark_older(thing)
    _set_groups(thing, _own_groups(thing))
    taken = _names(source) - set(_own_groups(thing))
    with _active(thing):
        bpy.ops.object.mode_set(mode="EDIT")
        try:
            _fill(thing.data, rig, taken)
        finally:
            bpy.ops.object.mode_set(mode="OBJECT")
    remember(thing, source, rig.made_of.points, rig.made_of.duplicates, rig.warnings)
    thing[BONES] = rig.bones.count
    return thing


def _check_lengths(rig: Rig) -> None:
    shortest = float(np.linalg.norm(rig.bones.tail - rig.bones.head, axis=1).min(initial=np.inf))
    if shortest <= _SHORTEST:
        raise InvalidInputError(
            f"Expected bones longer than {_SHORTEST:g}, for Blender deletes shorter ones, found one of "
            f"{shortest:.2g}; scale the object up"
        )


def bind_by_axis(source: bpy.types.Object, armature: bpy.types.Object, rig: Rig) -> None:
    """Weights of the axis, as vertex groups; a modifier; and the armature as parent."""
    _forget_groups(source, armature)
    groups = [source.vertex_groups.new(name=name) for name in _bones_of(armature, rig)]
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
    with _active(armature):
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


def _fill(armature: bpy.types.Armature, rig: Rig, taken: set[str]) -> None:
    """Give the armature the bones of a rig; a bone that was made before for the same place in it is used again.

    `taken` are names of vertex groups that belong to something else, which no bone may have.
    """
    bones, made = rig.bones, []
    old = {bone[_MADE]: bone for bone in armature.edit_bones if _MADE in bone}
    for name in old.keys() - set(rig.names):
        armature.edit_bones.remove(old.pop(name))
    for number, name in enumerate(rig.names):
        bone = old.get(name)
        if bone is None:
            bone = armature.edit_bones.new(_free_name(name, taken))
            bone[_MADE] = name
        bone.use_connect, bone.parent = False, None
        made.append(bone)
        bone.head, bone.tail = bones.head[number].tolist(), bones.tail[number].tolist()
        bone.head_radius = float(bones.head_radius[number])
        bone.tail_radius = float(bones.tail_radius[number])
    for number, bone in enumerate(made):
        if bones.parent[number] >= 0:
            bone.parent, bone.use_connect = made[bones.parent[number]], True


def _free_name(name: str, taken: set[str]) -> str:
    """The name, or the first with a number behind it that no foreign vertex group has."""
    numbered = (f"{name}.{number:03d}" for number in itertools.count(1))
    return name if name not in taken else next(n for n in numbered if n not in taken)


def _bones_of(armature: bpy.types.Object, rig: Rig) -> list[str]:
    """The bones of a rig by the names that they have in the armature, in the order of the rig."""
    names = {bone[_MADE]: bone.name for bone in armature.data.bones if _MADE in bone}
    return [names[name] for name in rig.names]


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


def _mark_older(armature: bpy.types.Object) -> None:
    """Mark the bones and groups of an armature from before they were marked: all of its bones were made here."""
    bones = armature.data.bones
    if len(bones) and not any(_MADE in bone for bone in bones):
        for bone in bones:
            bone[_MADE] = bone.name
        _set_groups(armature, [bone.name for bone in bones])


def _names(source: bpy.types.Object) -> set[str]:
    return {group.name for group in source.vertex_groups}


def _own_groups(armature: bpy.types.Object) -> list[str]:
    """The vertex groups that were made for this armature, by the names that they have now."""
    now = {bone[_GROUP]: bone.name for bone in armature.data.bones if _GROUP in bone}
    return [now.get(name, name) for name in armature.get(_GROUPS, "").splitlines()]


def _set_groups(armature: bpy.types.Object, names: list[str]) -> None:
    armature[_GROUPS] = "\n".join(names)
    for bone in armature.data.bones:
        if bone.name in names:
            bone[_GROUP] = bone.name


def _remember_groups(
    source: bpy.types.Object, armature: bpy.types.Object, names: list[str]
) -> None:
    _set_groups(armature, names)
    armature[_WEIGHTS] = _hash_of_weights(source, names)


def _forget_groups(source: bpy.types.Object, armature: bpy.types.Object) -> None:
    """Remove the vertex groups that were made for this armature before."""
    for name in _own_groups(armature):
        if group := source.vertex_groups.get(name):
            source.vertex_groups.remove(group)
    _set_groups(armature, [])


def _is_painted(source: bpy.types.Object, armature: bpy.types.Object) -> bool:
    """Whether someone changed the weights since they were made; groups that are gone have nothing to lose."""
    names = _own_groups(armature)
    if _names(source).isdisjoint(names) or _WEIGHTS not in armature:
        return False
    return armature[_WEIGHTS] != _hash_of_weights(source, names)


def _hash_of_weights(source: bpy.types.Object, names: list[str]) -> str:
    """A hash of the weights in some groups, whatever these are called."""
    place = {name: number for number, name in enumerate(names)}
    column = {group.index: place.get(group.name) for group in source.vertex_groups}
    digest = hashlib.blake2b(digest_size=16)
    for vertex in source.data.vertices:
        rows = ((column[g.group], g.weight) for g in vertex.groups)
        digest.update(repr(sorted(row for row in rows if row[0] is not None)).encode())
    return digest.hexdigest()


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
