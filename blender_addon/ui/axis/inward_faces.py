# SPDX-License-Identifier: GPL-3.0-or-later
"""Select and Turn Inward Faces: what a computation read the other way round, in the mesh itself."""

import bpy

from ...bridge.axis.axis_object import is_result
from ...bridge.mesh import stored
from ...bridge.objects.output_object import is_gone, source_of
from ...bridge.thickness.inward_faces import select_inward, turn_inward
from ...core.errors import MedialAxisError
from ..base.plain_words import Needing, Telling


def _mesh_of(context):
    """The active mesh, or the one whose result is active."""
    active = context.object
    if is_gone(active):
        return None
    thing = source_of(active) if is_result(active) else active
    return None if is_gone(thing) or thing.type != "MESH" else thing


class OBJECT_OT_medial_axis_inward_faces(Needing, Telling, bpy.types.Operator):
    bl_idname = "object.medial_axis_inward_faces"
    bl_label = "Inward Faces"
    bl_description = "Faces of the mesh that look inward by votes of rays. The medial axis does not depend on this"
    bl_options = {"REGISTER", "UNDO"}

    action: bpy.props.EnumProperty(
        name="Action",
        description="What happens to the faces that look inward",
        items=[
            ("SELECT", "Select", "Select these faces in Edit Mode, and no others"),
            ("TURN", "Turn", "Turn these faces round, so that all faces look outward"),
        ],
        default="SELECT",
    )

    needs = "Select a mesh, or a medial axis whose mesh is still there"
    find = staticmethod(_mesh_of)

    def run(self, context):
        thing = _mesh_of(context)
        try:
            if self.action == "TURN":
                return f"{turn_inward(thing):,} faces were turned round"
            return f"{select_inward(thing):,} faces look inward"
        except MedialAxisError as error:
            raise MedialAxisError(f"'{thing.name}': {error}") from error


def draw_inward_faces(layout, result):
    """Two buttons below the sentence about faces that looked inward."""
    if not result.get(stored.TURNED, 0):
        return
    row = layout.row(align=True)
    select = row.operator(
        "object.medial_axis_inward_faces", text="Select Them", icon="RESTRICT_SELECT_OFF"
    )
    select.action = "SELECT"
    turn = row.operator("object.medial_axis_inward_faces", text="Turn Them", icon="NORMALS_FACE")
    turn.action = "TURN"
