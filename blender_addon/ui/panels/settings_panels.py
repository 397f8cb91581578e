# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that an artist seldom needs, in panels inside a closed one: the look, sampling, and the method."""

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


class VIEW3D_PT_medial_axis_look(InSettings, bpy.types.Panel):
    """The other sliders of the form, and how the result is seen; they act at once"""

    bl_label = "Look"
    bl_idname = "VIEW3D_PT_medial_axis_look"

    def draw(self, context):
        settings, column = context.scene.medial_axis, settings_column(self.layout)
        draw_more_of_form(context, column, settings)
        is_published = Form[settings.form] is Form.PUBLISHED
        name = "smallest_island" if is_published else "crumbs"
        draw_setting(column, settings, name, slider=True)
        column.prop(settings, "lone_points")
        draw_setting(column, settings, "by_part")
        thing = shown_thing(context)
        modifier = thing and wires_of(thing)
        if modifier and (width := width_of(modifier)):
            column.prop(*width, text="Wire Width")


class VIEW3D_PT_medial_axis_sampling(InSettings, bpy.types.Panel):
    """How faces are sampled, and the report"""

    bl_label = "Sampling"
    bl_idname = "VIEW3D_PT_medial_axis_sampling"

    def draw(self, context):
        settings, column = context.scene.medial_axis, settings_column(self.layout)
        column.prop(settings, "sampling", text="")
        # The seed is in the panel of the operator.
        names = [name for name in SAMPLING_OPTIONS if name not in (*AS_IN_PAPER, "seed")]
        draw_sampling(column, settings, settings_from(settings).options_of_faces, names)
        draw_setting(column, settings, "each_part")
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
            if applies_to_form(name, Form[settings.form]):
                draw_setting(column, settings, name)
        draw_sampling(column, settings, settings_from(settings).options_of_faces, AS_IN_PAPER)
