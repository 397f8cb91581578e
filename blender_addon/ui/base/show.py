# SPDX-License-Identifier: GPL-3.0-or-later
"""The button that makes a result easier to see: colours in Solid view."""

import bpy

from . import current_job

_before = {}  # a viewport -> what it showed before Show Colours


def shows_colours(space) -> bool:
    """Whether a 3D viewport shows the attributes of meshes as colours."""
    return space.shading.type == "SOLID" and space.shading.color_type == "VERTEX"


def show_colours(space):
    """Show the attributes of meshes as colours in a 3D viewport, which remembers what it showed before."""
    shading = space.shading
    kind, shading.type = shading.type, "SOLID"
    _before[space.as_pointer()] = kind, shading.color_type
    shading.color_type = "VERTEX"


def draw_colours(context, layout):
    """The button that shows colours, pressed while they are shown."""
    shown = shows_colours(context.space_data)
    layout.operator("view3d.medial_axis_show_colours", icon="COLOR", depress=shown)


class VIEW3D_OT_medial_axis_show_colours(bpy.types.Operator):
    bl_idname = "view3d.medial_axis_show_colours"
    bl_label = "Show Colours"
    bl_description = (
        "Solid view with Color: Attribute in this viewport; pressed again, what it showed before"
    )
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        return getattr(context.space_data, "type", "") == "VIEW_3D"

    def execute(self, context):
        current_job.settle()  # the legend comes or goes
        space = context.space_data
        if not shows_colours(space):
            show_colours(space)
            return {"FINISHED"}
        kind, colour = _before.pop(space.as_pointer(), ("SOLID", "MATERIAL"))
        space.shading.color_type = colour  # first, for another kind may know other ones
        space.shading.type = kind
        return {"FINISHED"}


def unregister():
    _before.clear()
