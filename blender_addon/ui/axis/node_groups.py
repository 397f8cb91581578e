# SPDX-License-Identifier: GPL-3.0-or-later
"""Add > Medial Axis: groups of Geometry Nodes as modifiers of the active medial axis."""

import bpy

from ...bridge.axis.read_axis import find_axis
from ...bridge.nodes.groups import GROUPS, add_few_balls, add_modifier
from ...bridge.nodes.inputs import input_of
from ..base.plain_words import Needing
from ..base.translation import say


class OBJECT_OT_medial_axis_nodes(Needing, bpy.types.Operator):
    bl_idname = "object.medial_axis_nodes"
    bl_label = "Add Medial Axis Nodes"
    bl_description = "Give the medial axis a modifier of Geometry Nodes, which is live"
    bl_options = {"REGISTER", "UNDO"}

    group: bpy.props.EnumProperty(
        name="Group",
        description="What the modifier does",
        items=[(key, group.name, group.about) for key, group in GROUPS.items() if group.of_axes],
        default="FILTER",
    )

    @classmethod
    def find(cls, context):
        return find_axis(context.object)

    def execute(self, context):
        axis = find_axis(context.object)
        if self.group == "BALLS":
            modifier = add_few_balls(axis)
            if input_of(modifier, "Merge") > 0.0:
                count = len(axis.data.vertices)
                self.report({"INFO"}, say(f"Some 4,000 balls of {count:,}; Merge 0 shows all"))
        else:
            add_modifier(axis, self.group)
        return {"FINISHED"}


class VIEW3D_MT_medial_axis_nodes(bpy.types.Menu):
    bl_idname = "VIEW3D_MT_medial_axis_nodes"
    bl_label = "Medial Axis"

    def draw(self, _context):
        for key, group in GROUPS.items():
            if not group.of_axes:
                continue
            button = self.layout.operator(
                OBJECT_OT_medial_axis_nodes.bl_idname, text=group.name, icon="GEOMETRY_NODES"
            )
            button.group = key


def _entry(self, _context):
    self.layout.separator()
    self.layout.menu(VIEW3D_MT_medial_axis_nodes.bl_idname, icon="GEOMETRY_NODES")


ENTRIES = {bpy.types.VIEW3D_MT_add: _entry}
