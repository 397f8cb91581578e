# SPDX-License-Identifier: GPL-3.0-or-later
"""Object > Medial Axis: everything that can be done, in the order of the panels; F3 searches menus, so it finds all."""

import bpy

from ...core.settings import BALL_OPTIONS, THICKNESS_OPTIONS
from ..axis.compute_sequence import copy_sequence
from ..axis.node_groups import VIEW3D_MT_medial_axis_nodes
from ..settings.properties import copy_settings
from ..skeleton.skeleton_operators import SKELETON_OPERATORS, copy_all

# Operators by the panel to which they belong; a group of several operators ends with a line.
_VERBS = (
    {
        "object.medial_axis": "OUTLINER_DATA_MESH",
        "object.medial_axis_reduce": "MOD_DECIM",
        "object.medial_axis_simplify_to_gap": "LIGHT",
        "object.medial_axis_select_part": "RESTRICT_SELECT_OFF",
        "object.medial_axis_separate_parts": "OUTLINER_COLLECTION",
    },
    {**SKELETON_OPERATORS, "object.medial_axis_to_curve": "OUTLINER_OB_CURVE"},
    {
        "object.medial_axis_thickness": "DRIVER_DISTANCE",
        "object.medial_axis_thicken": "MOD_SOLIDIFY",
        "object.medial_axis_unsolidify": "MOD_SOLIDIFY",
        "object.medial_axis_hollow": "MESH_UVSPHERE",
        "object.medial_axis_solidify": "MOD_SOLIDIFY",
    },
    {
        "object.medial_axis_rebuild": "MOD_REMESH",
        "object.tight_cocone_surface": "MESH_ICOSPHERE",
    },
    {"object.medial_axis_balls": "META_BALL"},
    {
        "object.medial_axis_sequence": "RENDER_ANIMATION",
        "object.medial_axis_sampling_report": "VIEWZOOM",
    },
)


class VIEW3D_MT_medial_axis(bpy.types.Menu):
    bl_idname = "VIEW3D_MT_medial_axis"
    bl_label = "Medial Axis"

    def draw(self, context):
        for group in _VERBS:
            for operator, icon in group.items():
                _copy_panels(context, operator, self.layout.operator(operator, icon=icon))
            self.layout.separator()
        self.layout.operator_menu_enum(
            "object.medial_axis_inward_faces", "action", icon="NORMALS_FACE"
        )
        self.layout.menu(
            VIEW3D_MT_medial_axis_nodes.bl_idname, text="Add Nodes", icon="GEOMETRY_NODES"
        )


def _copy_panels(context, operator, button):
    """Give a button the settings that the panels show."""
    scene = context.scene
    copy_all(context, button)
    if operator == "object.medial_axis_balls":
        copy_settings(scene.medial_axis_balls, button, BALL_OPTIONS)
    elif operator == "object.medial_axis_thickness":
        copy_settings(scene.medial_axis_thickness, button, THICKNESS_OPTIONS)
    elif operator == "object.medial_axis_thicken":
        button.limit = scene.medial_axis_thickness.limit
    elif operator == "object.medial_axis_hollow":
        button.wall = scene.medial_axis_thickness.limit
    elif operator == "object.medial_axis_solidify":
        button.thickness = scene.medial_axis_thickness.limit
    elif operator == "object.medial_axis_sequence":
        copy_sequence(scene, button)


def _entry(self, _context):
    self.layout.separator()
    self.layout.menu(VIEW3D_MT_medial_axis.bl_idname, icon="OUTLINER_DATA_MESH")


ENTRIES = {bpy.types.VIEW3D_MT_object: _entry, bpy.types.VIEW3D_MT_object_context_menu: _entry}
