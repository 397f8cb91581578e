# SPDX-License-Identifier: GPL-3.0-or-later
"""Rebuild Solid, and its panel: how thick, and how far from the source."""

import bpy

from ..bridge.axis.read_axis import find_axis
from ..bridge.mesh import stored
from ..bridge.nodes.inputs import row_of
from ..bridge.objects.step_back import are_back, seen, step_back
from ..bridge.rebuilt_object import measure, modifier_of, rebuild, rebuilt_of, unrebuilt
from .axis.compute_operator import Alone
from .base.plain_words import Needing, Telling
from .base.select_made import bring_into_view_layer
from .base.tab import Closed, settings_column
from .base.wrapped_text import draw_figures

_INPUTS = ("Voxel", "Factor", "Offset", "Min Radius", "Merge")


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
        return None if found is None else _sentence(made.name, found)


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


def _sentence(name, found):
    return (
        f"'{name}' is {100 * found.mean:.3f} % of the diagonal away (mean), at most "
        f"{100 * found.largest:.2f} %, and has {100 * found.volume:.1f} % of the volume"
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
        label = "Rebuild Solid" if made is None else "Measure Again"
        row = layout.row(align=True)
        row.operator("object.medial_axis_rebuild", text=label, icon="MESH_ICOSPHERE")
        if made is not None:
            icon = "HIDE_ON" if are_back(made) else "HIDE_OFF"
            row.operator("object.medial_axis_others", text="", icon=icon).name = made.name
            _draw_inputs(layout, made)
            _draw_difference(layout, made)


def _draw_inputs(layout, made):
    modifier = modifier_of(made)
    if modifier is None:
        return
    column = settings_column(layout)
    for name in _INPUTS:
        owner, path = row_of(modifier, name)
        column.prop(owner, path, text=name)


def _draw_difference(layout, made):
    if stored.REBUILT_MEAN not in made:
        return
    figures = {
        "Mean Distance": f"{100 * made[stored.REBUILT_MEAN]:.3f} %",
        "Max Distance": f"{100 * made[stored.REBUILT_LARGEST]:.2f} %",
        "Volume": f"{100 * made[stored.REBUILT_VOLUME]:.1f} %",
    }
    draw_figures(layout, figures, 0.6)
