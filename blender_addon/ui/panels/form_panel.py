# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the panel that choose the form of the axis, and the value of Simplify that the sheets of a model suggest,
where they do."""

import bpy

from ...bridge.axis.slider_ranges import gap_on
from ...core.settings import Form, applies_to_form
from ..base.plain_words import Needing
from ..base.ranged_sliders import draw_slider
from ..settings.properties import settings_from, shown_result

_SLIDERS = ("simplify", "erode", "spike", "detail", "limb")


def draw_form(context, layout, panel):
    """Form, and the slider that matters most for it."""
    layout.prop(panel, "form")
    _draw_sliders(context, layout, _that_apply(panel)[:1])


def draw_more_of_form(context, layout, panel):
    """The other sliders of the form, and whether its places are crisp."""
    _draw_sliders(context, layout, _that_apply(panel)[1:])
    if settings_from(panel).crisp_is_possible:
        layout.prop(panel, "crisp")


def _draw_sliders(context, layout, names):
    result = shown_result(context)
    for name in names:
        row = layout.row(align=True)
        draw_slider(context, row, name, result)
        if name == "simplify" and gap_on(result) is not None:
            row.operator("object.medial_axis_simplify_to_gap", text="", icon="LIGHT")


def _that_apply(panel):
    return [name for name in _SLIDERS if applies_to_form(name, Form[panel.form])]


class OBJECT_OT_medial_axis_simplify_to_gap(Needing, bpy.types.Operator):
    bl_idname = "object.medial_axis_simplify_to_gap"
    bl_label = "Simplify to Gap"
    bl_description = (
        "Drop the thin sheets, as of noise or small details, and keep the others: these are at least three times as "
        "thick, and nothing lies between"
    )
    bl_options = {"REGISTER", "UNDO"}

    needs = "Select a medial axis of Form Clean that has thin sheets and others, and a clear gap between them"

    @classmethod
    def find(cls, context):
        is_clean = context.scene.medial_axis.form == Form.CLEAN.name
        return gap_on(shown_result(context)) if is_clean else None

    def execute(self, context):
        context.scene.medial_axis.simplify = self.find(context)
        return {"FINISHED"}
