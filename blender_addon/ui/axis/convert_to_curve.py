# SPDX-License-Identifier: GPL-3.0-or-later
"""Convert to Curve: the loose edges of a medial axis as a curve object."""

import bpy

from ...bridge.axis.read_axis import find_axis
from ...bridge.nodes.wires import WIRES
from ...bridge.skeleton.curve_object import write_curve
from ...core.errors import MedialAxisError
from ..base.plain_words import told
from ..base.select_made import bring_into_view_layer, select_made
from ..base.translation import say


class OBJECT_OT_medial_axis_to_curve(bpy.types.Operator):
    bl_idname = "object.medial_axis_to_curve"
    bl_label = "Convert to Curve"
    bl_description = (
        "Make a curve object of the loose edges of the medial axis, with its radius at every point; "
        "the medial axis stays"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        axis = find_axis(context.active_object)
        if axis is None or not axis.get(WIRES, 0):
            cls.poll_message_set(say("Select a medial axis with loose edges, as of Form Curve"))
            return False
        return True

    def execute(self, context):
        try:
            made = write_curve(find_axis(context.active_object))
        except MedialAxisError as error:
            self.report({"ERROR"}, told(str(error)))
            return {"CANCELLED"}
        bring_into_view_layer(context, made)
        select_made(context, [made])
        return {"FINISHED"}
