# SPDX-License-Identifier: GPL-3.0-or-later
"""Rebuild Solid, and its panel: how thick, and how far from the source."""

import bpy

from ..bridge.axis.read_axis import find_axis
from ..bridge.mesh import stored
from ..bridge.objects.step_back import are_back, seen, step_back
from ..bridge.rebuilt_object import measure, rebuild, rebuilt_of, unrebuilt
from .axis.compute_operator import Alone
from .base.plain_words import Needing, Telling
from .base.select_made import bring_into_view_layer
from .base.tab import Closed
from .base.wrapped_text import draw_wrapped


def _axis(context):
    """The axis that the active object is, has, or was rebuilt of."""
    return find_axis(unrebuilt(context.object))


class OBJECT_OT_medial_axis_rebuild(Alone, Needing, Telling, bpy.types.Operator):
    bl_idname = "object.medial_axis_rebuild"
    bl_label = "Rebuild Solid"
    bl_description = (
        "Make the solid again from the medial axis and its radii, live, and measure how far it is "
        "from the object"
    )
    bl_options = {"REGISTER", "UNDO"}

    find = staticmethod(_axis)

    def invoke(self, context, _event):
        if not self.properties.is_property_set("alone"):
            self.alone = rebuilt_of(_axis(context)) is None
        return self.execute(context)

    def run(self, context):
        made = rebuild(_axis(context))
        bring_into_view_layer(context, made)
        back = self.alone or are_back(made)
        with seen([made]):
            found = measure(made, context.evaluated_depsgraph_get())
        step_back(made, back)
        if self.alone and context.mode == "OBJECT":
            made.select_set(True)
            context.view_layer.objects.active = made
        return found and f"'{made.name}' is {_sentence(found.mean, found.largest, found.volume)}"


class OBJECT_OT_medial_axis_others(bpy.types.Operator):
    bl_idname = "object.medial_axis_others"
    bl_label = "Show Others"
    bl_description = "Show or hide the object and its medial axis, which fill the same place"
    bl_options = {"INTERNAL", "UNDO"}

    name: bpy.props.StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, _context):
        made = bpy.data.objects.get(self.name)
        if made is None:
            return {"CANCELLED"}
        step_back(made, not are_back(made))
        return {"FINISHED"}


def _sentence(mean, largest, volume):
    return (
        f"{100 * mean:.3f} % of the diagonal away (mean), at most {100 * largest:.2f} %, and has "
        f"{100 * volume:.1f} % of the volume"
    )


class VIEW3D_PT_medial_axis_rebuild(Closed, bpy.types.Panel):
    """The solid again"""

    bl_label = "Rebuild"
    bl_idname = "VIEW3D_PT_medial_axis_rebuild"

    @classmethod
    def poll(cls, context):
        return _axis(context) is not None

    def draw(self, context):
        layout = self.layout
        made = rebuilt_of(_axis(context))
        row = layout.row(align=True)
        row.operator("object.medial_axis_rebuild", icon="MESH_ICOSPHERE")
        if made is not None:
            icon = "HIDE_ON" if are_back(made) else "HIDE_OFF"
            row.operator("object.medial_axis_others", text="", icon=icon).name = made.name
            if stored.REBUILT_MEAN in made:
                names = (stored.REBUILT_MEAN, stored.REBUILT_LARGEST, stored.REBUILT_VOLUME)
                draw_wrapped(context, layout, _sentence(*(made[name] for name in names)), "INFO")
