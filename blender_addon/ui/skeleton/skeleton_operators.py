# SPDX-License-Identifier: GPL-3.0-or-later
"""Extract Skeleton and Make Armature."""

from dataclasses import dataclass
from functools import partial

import bpy

from ...bridge.axis.axis_object import shown_curve
from ...bridge.mesh import stored
from ...bridge.objects.read_object import read_object
from ...bridge.objects.source_state import same_state
from ...bridge.skeleton.armature_object import (
    check_no_other,
    find_armature,
    in_rest,
    write_armature,
)
from ...bridge.skeleton.bind_armature import (
    bind_by_axis,
    bind_by_heat,
    check_bindable,
    groups_of_others,
)
from ...bridge.skeleton.skeleton_object import (
    check_parts_writable,
    check_skeleton_writable,
    selected_ends,
    write_parts,
    write_skeleton,
)
from ...core.rig.rig import compute_rig
from ...core.settings import (
    BIND,
    LOOKS,
    RIG_OPTIONS,
    SKELETON_OPTIONS,
    LimbControl,
    SkeletonSettings,
)
from ...core.skeleton.compute import compute_skeleton
from ..axis.compute_operator import Read, SampledOperator
from ..base.translation import say
from ..settings.preferences import memory_limit
from ..settings.properties import (
    copy_settings,
    prop,
    settings_from,
    with_options,
)

SKELETON_OPERATORS = {
    "object.medial_axis_skeleton": "OUTLINER_OB_CURVE",
    "object.medial_axis_armature": "OUTLINER_OB_ARMATURE",
}
HEAT_FAILED = "Automatic weights left vertices without a bone; the weights of the axis were taken"


@with_options(SKELETON_OPTIONS)
class SkeletonProperties:
    """The options of a skeleton."""


@dataclass(frozen=True)
class _Wanted(Read):
    """A shape, the ends on it that are kept, and the settings of the curve that is shown of it, if there are any."""

    ends: object
    shown: object


class SkeletonOperator(SampledOperator, SkeletonProperties):
    """The base of the two, which can keep what joins the selected ends, and can start from the curve that is seen."""

    selected_ends: bpy.props.BoolProperty(
        name="Selected Ends",
        description="Keep only what joins the vertices that are selected in Edit Mode, one or a few at each end",
        default=False,
    )
    as_shown: bpy.props.BoolProperty(
        name="As Shown",
        description="Keep the loops and branches of the curve that is shown, where Form is Curve and its Detail is "
        "below 1, whatever Detail says here",
        default=True,
    )

    def read(self, thing, depsgraph):
        shape = read_object(thing, depsgraph)
        ends = selected_ends(thing, shape) if self.selected_ends else None
        return _Wanted(shape, ends, shown_curve(thing) if self.as_shown else None)

    def computed(self, compute, wanted, *more):
        """The work of a task: a skeleton, or what is made of one."""
        settings = settings_from(self), settings_from(self, SkeletonSettings), *more
        words = {"limit": memory_limit(), "ends": wanted.ends, "shown": wanted.shown}
        return partial(compute, wanted.shape, *settings, **words)


@with_options(RIG_OPTIONS)
class ArmatureProperties:
    """The options of the bones of an armature."""

    bind: prop(BIND)


def copy_all(context, button) -> None:
    """Set the properties of an operator button to those of the panels."""
    copy_settings(context.scene.medial_axis, button)
    copy_settings(
        context.scene.medial_axis_skeleton, button, (*SKELETON_OPTIONS, "per_limb", "bind")
    )


class OBJECT_OT_medial_axis_skeleton(SkeletonOperator, bpy.types.Operator):
    bl_idname = "object.medial_axis_skeleton"
    bl_label = "Extract Skeleton"
    bl_description = (
        "Make a curve along the middle of the selected objects, with the radius at every point"
    )

    product = "skeleton"
    shown = (*SKELETON_OPTIONS, "as_shown", "selected_ends", "parts", "parent")

    parent: prop(LOOKS["parent"])
    parts: bpy.props.BoolProperty(
        name="Parts",
        description="Also give the faces of the object itself the attribute ma_part: the branch "
        "that each belongs to",
        default=False,
    )

    def check_writable(self, thing):
        check_skeleton_writable(thing)
        if self.parts:
            check_parts_writable(thing)

    def work(self, wanted):
        return self.computed(compute_skeleton, wanted)

    def write(self, thing, found, frame):
        made = write_skeleton(thing, found, frame)
        if self.parts:
            write_parts(thing, found)
        return made

    def summary(self, found):
        skeleton = found.skeleton
        return f"{skeleton.count:,} branches, {skeleton.tips:,} ends, {skeleton.loops:,} loops"


class OBJECT_OT_medial_axis_armature(SkeletonOperator, ArmatureProperties, bpy.types.Operator):
    bl_idname = "object.medial_axis_armature"
    bl_label = "Make Armature"
    bl_description = (
        "Make few bones along the skeleton of the selected objects, and bind these to them"
    )

    product = "armature"
    parent = False  # the object follows its bones
    shown = (*SKELETON_OPTIONS, "as_shown", "selected_ends")

    replace_weights: bpy.props.BoolProperty(
        name="Replace Weights",
        description="Replace weights also where they were painted since they were made",
        default=False,
    )
    armature: bpy.props.StringProperty(
        name="Armature",
        description="Add the bones to this armature; without a name, the object gets one of its own",
    )

    def draw(self, context):
        self.layout.use_property_split = True
        for name in (*RIG_OPTIONS, "bind", "replace_weights"):
            self.layout.prop(self, name)
        self.layout.prop_search(self, "armature", bpy.data, "objects")
        super().draw(context)

    def check_writable(self, thing):
        check_bindable(thing, self.bind != "NONE", self.replace_weights)
        check_no_other(thing, find_armature(self.armature))

    def read(self, thing, _depsgraph):
        with in_rest(thing):
            return super().read(thing, bpy.context.evaluated_depsgraph_get())

    def work(self, wanted):
        return self.computed(compute_rig, wanted, self.per_limb)

    def write(self, thing, rig, frame):
        taken, into = groups_of_others(thing), find_armature(self.armature)
        made = write_armature(thing, rig, frame, taken, LimbControl(self.ik), into)
        with same_state(thing):
            self._bind(thing, made, rig)
        return made

    def _bind(self, thing, made, rig):
        if self.bind == "AUTOMATIC" and not bind_by_heat(thing, made, rig):
            self.report({"WARNING"}, say(HEAT_FAILED))
            made[stored.WARNINGS] = "\n".join([*rig.warnings, HEAT_FAILED])
            bind_by_axis(thing, made, rig)
        elif self.bind == "AXIS":
            bind_by_axis(thing, made, rig)

    def summary(self, rig):
        skeleton = rig.made_of.skeleton
        return f"{rig.bones.count:,} bones, {skeleton.tips:,} ends"


class MedialAxisSkeletonSettings(SkeletonProperties, ArmatureProperties, bpy.types.PropertyGroup):
    """The settings of the panel of skeletons."""


PROPERTIES = {
    (bpy.types.Scene, "medial_axis_skeleton"): bpy.props.PointerProperty(
        type=MedialAxisSkeletonSettings
    )
}
