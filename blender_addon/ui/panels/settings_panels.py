# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that an artist seldom needs, in panels inside a closed one: form, sampling, method, and the look."""

import bpy

from ...bridge.nodes.wires import width_of, wires_of
from ...core.settings import AS_IN_PAPER, SAMPLING_OPTIONS, Form, applies_to_form
from ..base.tab import SETTINGS, Closed, InSettings, draw_setting, draws_buttons, settings_column
from ..settings.properties import copy_settings, draw_sampling, settings_from, shown_thing
from .form_panel import draw_more_of_form


class VIEW3D_PT_medial_axis_settings(Closed, bpy.types.Panel):
    """All other settings of the computation, and the look of the result"""

    bl_label = "Settings"
    bl_idname = SETTINGS

    def draw(self, _context):
        pass  # it holds the others


class VIEW3D_PT_medial_axis_form(InSettings, bpy.types.Panel):
    """The other sliders of the form"""

    bl_label = "Clean Up"
    bl_idname = "VIEW3D_PT_medial_axis_form"

    def draw(self, context):
        draw_more_of_form(context, settings_column(self.layout), context.scene.medial_axis)


class VIEW3D_PT_medial_axis_sampling(InSettings, bpy.types.Panel):
    """How faces are sampled, and the report"""

    bl_label = "Sampling"
    bl_idname = "VIEW3D_PT_medial_axis_sampling"

    def draw(self, context):
        settings, column = context.scene.medial_axis, settings_column(self.layout)
        column.prop(settings, "sampling")
        names = [name for name in SAMPLING_OPTIONS if name not in AS_IN_PAPER]
        draw_sampling(column, settings, settings_from(settings).options_of_faces, names)
        if draws_buttons(self.layout):
            button = self.layout.operator("object.medial_axis_sampling_report", icon="VIEWZOOM")
            copy_settings(settings, button)


class VIEW3D_PT_medial_axis_method(InSettings, bpy.types.Panel):
    """Choices that only readers of the paper need"""

    bl_label = "Method"
    bl_idname = "VIEW3D_PT_medial_axis_method"

    def draw(self, context):
        self.layout.label(text="As in the paper")
        settings, column = context.scene.medial_axis, settings_column(self.layout)
        for name in ("rule", "criteria", "limit_set", "mesh", "sides"):
            row = column.row()
            row.active = name != "mesh" or applies_to_form(name, Form[settings.form])
            draw_setting(row.column(), settings, name)
        draw_sampling(column, settings, settings_from(settings).options_of_faces, AS_IN_PAPER)
        draw_setting(column, settings, "each_part")


class VIEW3D_PT_medial_axis_show(InSettings, bpy.types.Panel):
    """How the result is seen"""

    bl_label = "Show"
    bl_idname = "VIEW3D_PT_medial_axis_show"

    @classmethod
    def poll(cls, context):
        return shown_thing(context) is not None

    def draw(self, context):
        thing, settings = shown_thing(context), context.scene.medial_axis
        column = settings_column(self.layout)
        column.prop(thing, "show_in_front", text="In Front")
        column.prop(settings, "parent")
        if Form[settings.form] is Form.PUBLISHED:
            draw_setting(column, settings, "smallest_island", slider=True)
        else:
            draw_setting(column, settings, "crumbs", slider=True)
        column.prop(settings, "lone_points")
        modifier = wires_of(thing)
        if modifier is not None and (width := width_of(modifier)):
            column.prop(*width, text="Wire Width")
