# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries in Blender's menus; being there is also what lets F3 find an operator."""

from ..core.settings import THICKNESS_OPTIONS
from .object_menus import object_menus
from .properties import copy_settings
from .skeleton_operators import SKELETON_OPERATORS, copy_all


def _compute(self, context):
    self.layout.separator()
    button = self.layout.operator("object.medial_axis", icon="OUTLINER_DATA_MESH")
    copy_settings(context.scene.medial_axis, button)
    button = self.layout.operator("object.medial_axis_sampling_report", icon="VIEWZOOM")
    copy_settings(context.scene.medial_axis, button)
    self.layout.operator("object.tight_cocone_surface", icon="MESH_ICOSPHERE")
    button = self.layout.operator("object.medial_axis_balls", icon="META_BALL")
    copy_settings(context.scene.medial_axis, button)
    button = self.layout.operator("object.medial_axis_thickness", icon="DRIVER_DISTANCE")
    copy_settings(context.scene.medial_axis, button)
    copy_settings(context.scene.medial_axis_thickness, button, THICKNESS_OPTIONS)
    self.layout.operator("object.medial_axis_rebuild", icon="MOD_REMESH")
    for operator, icon in SKELETON_OPERATORS.items():
        copy_all(context, self.layout.operator(operator, icon=icon))


def register():
    for menu in object_menus():
        menu.append(_compute)


def unregister():
    for menu in object_menus():
        menu.remove(_compute)
