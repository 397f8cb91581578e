# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that an artist seldom needs, in panels inside a closed one: form, sampling, method, and the look."""

import bpy

from ..bridge import output_object
from ..bridge.wires import width_of, wires_of
from ..core.settings import Form, SidesFrom
from .form_panel import draw_more_of_form
from .properties import copy_settings, draw_sampling, settings_from
from .show import draw_colours
from .shown import shown_thing
from .tab import SETTINGS, Closed, InSettings, draws_buttons, settings_column


class VIEW3D_PT_medial_axis_settings(Closed, bpy.types.Panel):
    """All other settings of the computation, and the look of the result"""

    bl_label = "Settings"
    bl_idname = SETTINGS

    def draw(self, _context):
        pass  # it holds the others


class VIEW3D_PT_medial_axis_form(InSettings, bpy.types.Panel):
    """The other sliders of the form"""

    bl_label = "Form"
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
        draw_sampling(column, settings, settings_from(settings).options_of_faces)
        if draws_buttons(self.layout):
            button = self.layout.operator("object.medial_axis_sampling_report", icon="VIEWZOOM")
            copy_settings(settings, button)


class VIEW3D_PT_medial_axis_method(InSettings, bpy.types.Panel):
    """Choices that the published method leaves open"""

    bl_label = "Method"
    bl_idname = "VIEW3D_PT_medial_axis_method"

    def draw(self, context):
        settings, column = context.scene.medial_axis, settings_column(self.layout)
        for name in ("rule", "criteria", "limit_set", "sides"):
            column.prop(settings, name)
        if settings.sides == SidesFrom.WRAP.name:
            column.prop(settings, "wrap_opening")
        column.prop(settings, "each_part")


class VIEW3D_PT_medial_axis_show(InSettings, bpy.types.Panel):
    """How the result is seen"""

    bl_label = "Show"
    bl_idname = "VIEW3D_PT_medial_axis_show"

    @classmethod
    def poll(cls, context):
        return shown_thing(context) is not None

    def draw(self, context):
        thing, settings = shown_thing(context), context.scene.medial_axis
        draw_colours(context, self.layout)
        column = settings_column(self.layout)
        column.prop(thing, "show_in_front", text="In Front")
        if output_object.source_of(thing) is not None:
            _draw_source(column, thing)
        column.prop(settings, "parent")
        if Form[settings.form] is Form.PUBLISHED:
            column.prop(settings, "smallest_island", slider=True)
        else:
            column.prop(settings, "crumbs", slider=True)
        modifier = wires_of(thing)
        if modifier is not None and (width := width_of(modifier)):
            column.prop(*width, text="Wire Width")


def _draw_source(layout, thing):
    source = output_object.source_of(thing)
    layout.operator(
        "object.medial_axis_source_as_wire",
        icon="SHADING_WIRE",
        depress=source.display_type == "WIRE",
    ).name = thing.name


CLASSES = (
    VIEW3D_PT_medial_axis_settings,
    VIEW3D_PT_medial_axis_form,
    VIEW3D_PT_medial_axis_sampling,
    VIEW3D_PT_medial_axis_method,
    VIEW3D_PT_medial_axis_show,
)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
