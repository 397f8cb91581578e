# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the panel: Blender's menu of them, with those that come with the add-on."""

from pathlib import Path

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from ...core.settings import OPTIONS

_SHIPPED = Path(__file__).resolve().parents[2] / "presets"
_FOLDER = "medial_axis"


class VIEW3D_PT_medial_axis_presets(PresetPanel, bpy.types.Panel):
    bl_space_type = "VIEW_3D"
    preset_subdir = _FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "scene.medial_axis_preset_add"

    def path_menu(self, searchpaths, *words, **options):
        """As of Blender; its search knows no folders of add-ons that are extensions."""
        paths = [str(_SHIPPED / _FOLDER), *searchpaths]
        return bpy.types.Menu.path_menu(self, paths, *words, **options)


class SCENE_OT_medial_axis_preset_add(AddPresetBase, bpy.types.Operator):
    bl_idname = "scene.medial_axis_preset_add"
    bl_label = "Add Medial Axis Preset"
    bl_description = "Add or remove a preset of the settings of the medial axis"

    preset_menu = "VIEW3D_PT_medial_axis_presets"
    preset_subdir = _FOLDER
    preset_defines = ()
    preset_values = tuple(f"bpy.context.scene.medial_axis.{name}" for name in OPTIONS)
