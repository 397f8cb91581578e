# SPDX-License-Identifier: GPL-3.0-or-later
"""Convert to Curve: the loose edges of a medial axis as a curve object."""

import bpy

from ...bridge.axis.read_axis import find_axis
from ...bridge.mesh import stored
from ...bridge.skeleton.curve_object import write_curve
from ..base.plain_words import Needing, Telling
from ..base.select_made import bring_into_view_layer, select_made


class OBJECT_OT_medial_axis_to_curve(Needing, Telling, bpy.types.Operator):
    bl_idname = "object.medial_axis_to_curve"
    bl_label = "Convert to Curve"
    bl_description = (
        "Make a curve object of the loose edges of the medial axis, with its radius at every point; "
        "the medial axis stays"
    )
    bl_options = {"REGISTER", "UNDO"}

    needs = "Select a medial axis with loose edges, as of Form Curve"

    @classmethod
    def find(cls, context):
        axis = find_axis(context.object)
        return axis if axis is not None and axis.get(stored.WIRES, 0) else None

    def run(self, context):
        made = write_curve(self.find(context))
        bring_into_view_layer(context, made)
        select_made(context, [made])
