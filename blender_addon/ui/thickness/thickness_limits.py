# SPDX-License-Identifier: GPL-3.0-or-later
"""Usual limits of thickness by how a thing is made, and a note where the unit of the scene looks wrong."""

import bpy

from ..axis.figures import length_text
from ..base.translation import say

# The least walls that makers usually ask for, in millimetres.
LIMITS = {
    "Printed from Filament (FDM)": 1.2,
    "Printed from Resin (SLA)": 0.6,
    "Sintered from Powder (SLS)": 0.7,
    "Moulded": 1.0,
    "Cast": 3.0,
}
_HUGE = 50.0  # metres: what is larger was probably made in millimetres


class SCENE_OT_medial_axis_thickness_limit(bpy.types.Operator):
    bl_idname = "scene.medial_axis_thickness_limit"
    bl_label = "Set Thickness Limit"
    bl_description = "Set the limit to so many millimetres, in the unit of the scene"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    millimetres: bpy.props.FloatProperty(name="Millimetres", default=1.0, min=0.0)

    def execute(self, context):
        context.scene.medial_axis_thickness.limit = self.millimetres / 1000.0 / _metres(context)
        return {"FINISHED"}


class VIEW3D_MT_medial_axis_thickness_limits(bpy.types.Menu):
    bl_idname = "VIEW3D_MT_medial_axis_thickness_limits"
    bl_label = "Usual Limits"

    def draw(self, _context):
        for name, limit in LIMITS.items():
            text = f"{say(name)}: {limit:g} mm"
            operator = "scene.medial_axis_thickness_limit"
            self.layout.operator(operator, text=text, translate=False).millimetres = limit


def unit_note(context, thing):
    """A sentence where an object is so large that its unit is probably another one; else an empty string."""
    size = thing.dimensions.length
    if size * _metres(context) <= _HUGE:
        return ""
    return (
        f"This is {length_text(context, size)} large; if it was made in millimetres, set Unit Scale to "
        "0.001 in the properties of the scene"
    )


def _metres(context):
    """How long Blender's unit is."""
    units = context.scene.unit_settings
    return 1.0 if units.system == "NONE" else units.scale_length
