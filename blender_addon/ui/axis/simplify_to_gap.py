# SPDX-License-Identifier: GPL-3.0-or-later
"""Simplify to Gap: the value of Simplify that the sheets of a model suggest, where they do."""

import bpy

from ...bridge.axis.slider_ranges import gap_on
from ...core.settings import Form
from ..base.plain_words import Needing
from ..settings.properties import shown_result


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
