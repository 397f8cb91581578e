# SPDX-License-Identifier: GPL-3.0-or-later
"""The sheets of a medial axis: how many there are, and operators that select and separate them."""

import bpy

from ...bridge.axis.axis_object import is_result, result_of
from ...bridge.axis.parts_objects import part_of_active_face, select_part, separate_parts
from ...bridge.axis.structure_object import counts_on
from ...bridge.mesh.attributes import PART
from ...bridge.objects.output_object import is_gone
from ..base.plain_words import Needing, Telling
from ..base.translation import say
from ..base.view_place import edit_faces
from ..base.wrapped_text import counted, draw_wrapped

_NONE = "Select a medial axis of the form Clean, or an object whose medial axis was computed before"


def _axis(context):
    """The axis with parts that the active object is or has."""
    active = context.object
    if is_gone(active):
        return None
    found = active if is_result(active) else result_of(active)
    return found if found is not None and PART.name in found.data.attributes else None


class _OfParts(Needing):
    bl_options = {"REGISTER", "UNDO"}

    find, needs = staticmethod(_axis), _NONE


class OBJECT_OT_medial_axis_select_part(_OfParts, bpy.types.Operator):
    bl_idname = "object.medial_axis_select_part"
    bl_label = "Select Part"
    bl_description = (
        "Select the faces of a sheet of the medial axis in edit mode: that of the active face, or "
        "the first one"
    )

    number: bpy.props.IntProperty(
        name="Part", description="The number of the sheet, as in ma_part", default=0, min=0
    )
    extend: bpy.props.BoolProperty(
        name="Extend", description="Keep what is selected", default=False
    )

    def invoke(self, context, _event):
        axis = _axis(context)
        if axis.mode == "EDIT":
            self.number = max(0, part_of_active_face(axis))
        return self.execute(context)

    def execute(self, context):
        axis = _axis(context)
        if context.object.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        count = select_part(axis, self.number, self.extend)
        edit_faces(context, axis)
        self.report({"INFO"}, say(f"Part {self.number} has {count:,} faces"))
        return {"FINISHED"}


class OBJECT_OT_medial_axis_separate_parts(_OfParts, Telling, bpy.types.Operator):
    bl_idname = "object.medial_axis_separate_parts"
    bl_label = "Separate Parts"
    bl_description = (
        "Make an object of each sheet of the medial axis, in a collection; the axis stays as it is"
    )

    def run(self, context):
        collection = separate_parts(_axis(context))
        return f"{len(collection.objects):,} parts in '{collection.name}'"


def draw_parts(context, layout):
    """How many sheets, seams and rims there are, and what can be done with them."""
    if axis := _axis(context):
        draw_wrapped(context, layout, counted(counts_on(axis)), "OUTLINER_COLLECTION")
        layout.operator("object.medial_axis_select_part", icon="RESTRICT_SELECT_OFF")
        layout.operator("object.medial_axis_separate_parts", icon="OUTLINER_COLLECTION")
