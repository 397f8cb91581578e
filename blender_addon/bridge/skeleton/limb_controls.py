# SPDX-License-Identifier: GPL-3.0-or-later
"""Limbs are moved together by Blender's own constraints: by a target, or by a line through controls."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import bpy
from mathutils import Vector

from ...core.rig.names import target_of
from ...core.rig.rig import Rig
from ...core.settings import LimbControl
from ..mesh import stored
from ..objects.output_object import new_object

IK = "Medial Axis IK"  # the constraints that were made here


@dataclass(frozen=True)
class Control:
    """A bone that deforms nothing, at the tail of a bone of a limb, or else at its head.

    `bone` is the bone of the limb, counted in the rig; `parent` is the bone of the rig on which the control hangs, -1
    for none.
    """

    name: str
    bone: int
    at_tail: bool
    parent: int


def controls_of(rig: Rig, limb: list[int], kind: LimbControl) -> list[Control]:
    """The controls of a limb, from its start: a target, or one for each joint and both ends.

    A target stays where it is when the body moves. Controls of a line go with the bone on which the limb hangs.
    """
    if kind is LimbControl.NONE or len(limb) < 2:
        return []
    first = rig.names[limb[0]]
    if kind is LimbControl.TARGET:
        return [Control(target_of(first), limb[-1], True, -1)]
    parent = int(rig.bones.parent[limb[0]])
    joints = [(bone, False) for bone in limb] + [(limb[-1], True)]
    return [
        Control(target_of(first, number), bone, at_tail, parent)
        for number, (bone, at_tail) in enumerate(joints, 1)
    ]


def release(source: bpy.types.Object, bones: Iterable[bpy.types.PoseBone]) -> None:
    """Remove the constraints and lines that were made here for the limbs of a source; its controls stay."""
    for bone in bones:
        for constraint in [c for c in bone.constraints if c.name == IK]:
            if constraint.type == "IK":
                for joint in _chain(bone, constraint):
                    joint.lock_ik_y = joint.lock_ik_z = False
            bone.constraints.remove(constraint)
    for line in [o for o in bpy.data.objects if o.get(stored.LIMB_LINE) == source]:
        bpy.data.curves.remove(line.data)


def constrain(
    source: bpy.types.Object,
    armature: bpy.types.Object,
    rig: Rig,
    bones: dict[str, bpy.types.PoseBone],
    kind: LimbControl,
) -> None:
    """Constrain limbs that are free to their controls; `bones` has those of the rig and the controls, by the names that
    they have there.
    """
    for limb in rig.limbs:
        controls = [bones[control.name] for control in controls_of(rig, limb, kind)]
        chain = [bones[rig.names[bone]] for bone in limb]
        if len(controls) == 1:
            _reach(armature, chain, controls[0])
        elif controls:
            _lie_along(source, armature, chain, controls)


def _chain(bone: bpy.types.PoseBone, constraint: bpy.types.Constraint) -> list[bpy.types.PoseBone]:
    """The bones of a limb that a constraint on the last one moves, from its start."""
    return [*reversed(bone.parent_recursive[: constraint.chain_count - 1]), bone]


def _reach(
    armature: bpy.types.Object, chain: list[bpy.types.PoseBone], target: bpy.types.PoseBone
) -> None:
    """Let a limb reach for its target; its joints but the first turn about one axis, so they bend in a plane."""
    reach = chain[-1].constraints.new("IK")
    reach.name, reach.target, reach.subtarget = IK, armature, target.name
    reach.chain_count = len(chain)
    for bone in chain[1:]:
        bone.lock_ik_y = bone.lock_ik_z = True


def _lie_along(
    source: bpy.types.Object,
    armature: bpy.types.Object,
    chain: list[bpy.types.PoseBone],
    controls: list[bpy.types.PoseBone],
) -> None:
    """Let a limb lie along a line through its controls, which is as long as the limb at rest."""
    places = [bone.bone.head_local for bone in chain] + [chain[-1].bone.tail_local]
    name = " " + target_of(chain[0].name)
    line = new_object(source, name, _curve(source.name + name, places))
    line[stored.LIMB_LINE] = source
    line.parent = armature
    line.hide_select = True
    for number, control in enumerate(controls):
        hook = line.modifiers.new(control.name, "HOOK")
        hook.object, hook.subtarget, hook.falloff_type = armature, control.name, "NONE"
        hook.vertex_indices_set([3 * number + k for k in range(3)])
        hook.matrix_inverse = control.bone.matrix_local.inverted()
    along = chain[-1].constraints.new("SPLINE_IK")
    along.name, along.target, along.chain_count = IK, line, len(chain)
    along.use_curve_radius = False


def _curve(name: str, places: list[Vector]) -> bpy.types.Curve:
    """A line of straight pieces that bends smoothly where its places move, for each has handles that go with it."""
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(len(places) - 1)
    before, after = 2 * places[0] - places[1], 2 * places[-1] - places[-2]
    ends = [before, *places, after]
    for point, left, place, right in zip(
        spline.bezier_points, ends, places, ends[2:], strict=False
    ):
        point.handle_left_type = point.handle_right_type = "FREE"
        point.co = place
        point.handle_left = place + (left - place) / 3
        point.handle_right = place + (right - place) / 3
    return curve
