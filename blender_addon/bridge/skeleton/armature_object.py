# SPDX-License-Identifier: GPL-3.0-or-later
"""Armatures along skeletons: how they are found, made and updated, also within an armature of the artist's own."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np
from mathutils import Vector

from ...core.arrays import Floats
from ...core.errors import InvalidInputError
from ...core.rig.rig import Rig
from ...core.settings import LimbControl
from ..mesh import stored
from ..objects.output_object import Product, check_mode, is_gone, new_object, place, remember
from .limb_controls import constrain, controls_of, release

_SHORTEST = 1e-6  # Blender deletes shorter bones


ARMATURE = Product(" Armature", (stored.BONES,), type="ARMATURE")
is_armature, armature_of = ARMATURE.has, ARMATURE.of


def rig_of(source: bpy.types.Object) -> bpy.types.Object | None:
    """The armature with the bones of a source: that which was made of it, or an artist's that they were added to."""
    made = armature_of(source)
    if made is not None:
        return made
    others = (o for o in bpy.data.objects if o.type == "ARMATURE" and not is_gone(o))
    return next((o for o in others if mark_of(o, source) is not None), None)


def mark_of(armature: bpy.types.Object, source: bpy.types.Object) -> str | None:
    """The end of the keys under which an armature keeps what belongs to a source; None where it keeps nothing.

    In an armature that was made of the source they end in nothing; in others, in the number of the source there.
    """
    if armature.get(stored.SOURCE) == source:
        return ""
    numbers = itertools.count(1)
    marks = itertools.takewhile(
        lambda mark: stored.SOURCE + mark in armature, (f"_{n}" for n in numbers)
    )
    return next((mark for mark in marks if armature[stored.SOURCE + mark] == source), None)


def find_armature(name: str) -> bpy.types.Object | None:
    """The artist's armature of this name, None for no name.

    Raises InvalidInputError where there is none, or bones cannot be added to it now.
    """
    if not name:
        return None
    thing = bpy.data.objects.get(name)
    if thing is None or thing.type != "ARMATURE":
        raise InvalidInputError(
            f"Expected the name of an armature, found '{name}', which is none; choose one, or clear the field"
        )
    if thing.library is not None or thing.data.library is not None or not thing.visible_get():
        raise InvalidInputError(
            f"Expected an armature of this file that is shown, found '{name}', which is not; "
            "show it, or make it local"
        )
    check_mode(thing)
    if not 0.0 < abs(thing.matrix_world.determinant()) < float("inf"):
        raise InvalidInputError(
            f"Expected a scale that Blender can invert, found one too large or too small of '{name}'; apply the scale"
        )
    return thing


def check_no_other(source: bpy.types.Object, into: bpy.types.Object | None) -> None:
    """Raise InvalidInputError when the bones of a source are in another armature than they are to be added to."""
    made = rig_of(source)
    if into is not None and made is not None and made != into:
        raise InvalidInputError(
            f"Expected no other armature of '{source.name}', found '{made.name}', and two would move it twice; "
            f"delete that, or clear the field of the armature"
        )


@contextmanager
def in_rest(source: bpy.types.Object) -> Iterator[None]:
    """The source without the modifier that binds it to its armature, so that it is read as it is at rest."""
    made = rig_of(source)
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


def write_armature(
    source: bpy.types.Object,
    rig: Rig,
    frame: np.ndarray,
    taken: set[str],
    ik: LimbControl = LimbControl.NONE,
    into: bpy.types.Object | None = None,
) -> bpy.types.Object:
    """Make the armature of a source, or give the existing one other bones; the source is not bound to it.

    Bones that an artist added stay, with their constraints, and so do the pose and the names that he gave to others.
    The armature of its own is symmetric in its X, where the body has two sides. `taken` are names of vertex groups that
    belong to something else, which no new bone may have. `ik` is what moves the bones of a limb together. `into` is an
    armature of the artist's own, which stays where it is.
    """
    thing = into or rig_of(source)
    own = thing is None or mark_of(thing, source) == ""
    if own:
        to_local = np.linalg.inv(rig.frame)
        _check_lengths(rig, to_local)
        if thing is None:
            armature = bpy.data.armatures.new(source.name + ARMATURE.suffix)
            thing = new_object(source, ARMATURE.suffix, armature)
            thing.show_in_front = True
        place(thing, frame @ rig.frame)
        bpy.context.view_layer.update()
        mark = ""
    else:
        to_local = np.linalg.inv(np.array(thing.matrix_world, np.float64)) @ frame
        _check_lengths(rig, to_local)
        mark = _new_mark(thing, source)
    moved = (
        to_local @ np.array(thing.get(stored.RIG_FRAME, rig.frame)).reshape(4, 4)
        if own
        else np.eye(4)
    )
    key = stored.MADE_BONE + mark
    if thing.pose is not None:
        release(source, [bone for bone in thing.pose.bones if key in bone.bone])
    with active(thing):
        bpy.ops.object.mode_set(mode="EDIT")
        try:
            _move_others(thing.data, moved)
            _fill(thing.data, rig, to_local, mark, taken, ik)
        finally:
            bpy.ops.object.mode_set(mode="OBJECT")
    named = {bone[key]: bone.name for bone in thing.data.bones if key in bone}
    constrain(source, thing, rig, {k: thing.pose.bones[v] for k, v in named.items()}, ik)
    if own:
        remember(thing, source, rig.made_of.points, rig.made_of.duplicates, rig.warnings)
        thing[stored.BONES], thing[stored.RIG_FRAME] = rig.bones.count, rig.frame.ravel().tolist()
    return thing


def bones_of(armature: bpy.types.Object, source: bpy.types.Object, rig: Rig) -> list[str]:
    """The bones of a rig by the names that they have in the armature, in the order of the rig."""
    mark = stored.MADE_BONE + (mark_of(armature, source) or "")
    names = {bone[mark]: bone.name for bone in armature.data.bones if mark in bone}
    return [names[name] for name in rig.names]


@contextmanager
def active(thing: bpy.types.Object) -> Iterator[None]:
    """One object active and selected alone, as Blender's operators want it; then as it was."""
    layer = bpy.context.view_layer
    before, selected = layer.objects.active, list(bpy.context.selected_objects)
    for other in selected:
        other.select_set(False)
    layer.objects.active = thing
    thing.select_set(True)
    try:
        yield
    finally:
        thing.select_set(False)
        layer.objects.active = before
        for other in selected:
            other.select_set(True)


def _new_mark(armature: bpy.types.Object, source: bpy.types.Object) -> str:
    """The mark of a source in an artist's armature, which is given to it where it has none."""
    mark = mark_of(armature, source)
    if mark is None:
        marks = (f"_{number}" for number in itertools.count(1))
        mark = next(mark for mark in marks if stored.SOURCE + mark not in armature)
        armature[stored.SOURCE + mark] = source
    return mark


def _check_lengths(rig: Rig, to_local: Floats) -> None:
    along = (rig.bones.tail - rig.bones.head) @ to_local[:3, :3].T
    shortest = float(np.linalg.norm(along, axis=1).min(initial=np.inf))
    if shortest <= _SHORTEST:
        raise InvalidInputError(
            f"Expected bones longer than {_SHORTEST:g}, for Blender deletes shorter ones, found one of "
            f"{shortest:.2g}; scale the object up"
        )


def _move_others(armature: bpy.types.Armature, moved: Floats) -> None:
    """Keep the bones of an artist in place when the frame of the armature has changed."""
    if np.allclose(moved, np.eye(4), rtol=0.0, atol=1e-12):
        return
    for bone in armature.edit_bones:
        if stored.MADE_BONE not in bone:
            up = Vector(moved[:3, :3] @ np.array(bone.z_axis))
            ends = [moved[:3, :3] @ np.array(end) + moved[:3, 3] for end in (bone.head, bone.tail)]
            bone.head, bone.tail = (end.tolist() for end in ends)
            bone.align_roll(up)


def _fill(
    armature: bpy.types.Armature,
    rig: Rig,
    to_local: Floats,
    mark: str,
    taken: set[str],
    ik: LimbControl,
) -> None:
    """Give the armature the bones of a rig; a bone that was made before for the same place in it is used again."""
    bones, turn = rig.bones, to_local[:3, :3]
    head, tail = (ends @ turn.T + to_local[:3, 3] for ends in (bones.head, bones.tail))
    scale = abs(float(np.linalg.det(turn))) ** (1.0 / 3.0)
    key = stored.MADE_BONE + mark
    controls = [control for limb in rig.limbs for control in controls_of(rig, limb, ik)]
    old = {bone[key]: bone for bone in armature.edit_bones if key in bone}
    names = [*rig.names, *(control.name for control in controls)]
    for name in old.keys() - set(names):
        armature.edit_bones.remove(old.pop(name))
    made = [_bone(armature, old, key, name, taken) for name in names]
    for number, bone in enumerate(made[: bones.count]):
        _lay(bone, head[number], tail[number], turn @ bones.up[number])
        bone.head_radius = scale * float(bones.head_radius[number])
        bone.tail_radius = scale * float(bones.tail_radius[number])
    for number, bone in enumerate(made[: bones.count]):
        if bones.parent[number] >= 0:
            bone.parent = made[bones.parent[number]]
            bone.use_connect = bool(bones.connected[number])
    for control, bone in zip(controls, made[bones.count :], strict=True):
        start = (tail if control.at_tail else head)[control.bone]
        beyond = start + (tail[control.bone] - head[control.bone]) / 2
        _lay(bone, start, beyond, turn @ bones.up[control.bone])
        bone.use_deform = False
        if control.parent >= 0:
            bone.parent = made[control.parent]


def _bone(
    armature: bpy.types.Armature,
    old: dict[str, bpy.types.EditBone],
    key: str,
    name: str,
    taken: set[str],
) -> bpy.types.EditBone:
    bone = old.get(name)
    if bone is None:
        bone = armature.edit_bones.new(_free_name(name, taken))
        bone[key] = name
    bone.use_connect, bone.parent = False, None
    return bone


def _lay(bone: bpy.types.EditBone, head: Floats, tail: Floats, up: Floats) -> None:
    bone.head, bone.tail = head.tolist(), tail.tolist()
    bone.align_roll(Vector(up.tolist()))


def _free_name(name: str, taken: set[str]) -> str:
    """The name, or the first with a number behind it that no foreign vertex group has."""
    numbered = (f"{name}.{number:03d}" for number in itertools.count(1))
    return name if name not in taken else next(n for n in numbered if n not in taken)
