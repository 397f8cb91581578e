# SPDX-License-Identifier: GPL-3.0-or-later
"""The node groups in Blender's asset browser: a library among the user's, until the add-on is disabled."""

from pathlib import Path

import bpy

from ..base.plain_words import told

FOLDER = Path(__file__).resolve().parents[2] / "nodes"
_NAME = "Medial Axis"


def library():
    """The entry of the user's preferences that leads here, or None."""
    return next((one for one in _libraries() if one.path and Path(one.path) == FOLDER), None)


def _libraries():
    return bpy.context.preferences.filepaths.asset_libraries


def _add():
    if hasattr(_libraries(), "new"):  # from 4.x
        _libraries().new(name=_NAME, directory=str(FOLDER))
    else:
        bpy.ops.preferences.asset_library_add(directory=str(FOLDER))
        library().name = _NAME
    bpy.context.preferences.is_dirty = True


def _remove():
    if hasattr(_libraries(), "remove"):
        _libraries().remove(library())
    else:
        index = list(_libraries()).index(library())
        bpy.ops.preferences.asset_library_remove(index=index)
    bpy.context.preferences.is_dirty = True


def draw_library(layout):
    """The button that registers the library, or takes it away again."""
    if library() is None:
        text, icon = "Show Node Groups in the Asset Browser", "ASSET_MANAGER"
    else:
        text, icon = "Remove Node Groups from the Asset Browser", "X"
    layout.operator("wm.medial_axis_asset_library", text=text, icon=icon)


class WM_OT_medial_axis_asset_library(bpy.types.Operator):
    bl_idname = "wm.medial_axis_asset_library"
    bl_label = "Node Groups in the Asset Browser"
    bl_description = (
        "Add the folder of the add-on's node groups to your asset libraries, or take it away again; "
        "disabling the add-on takes it away, too"
    )

    def execute(self, _context):
        if library() is not None:
            _remove()
            return {"FINISHED"}
        if not FOLDER.is_dir():
            found = (
                f"Expected the folder '{FOLDER}', found none; install the add-on from its zip file"
            )
            self.report({"ERROR"}, told(found))
            return {"CANCELLED"}
        _add()
        return {"FINISHED"}


def unregister():
    if library() is not None:
        _remove()
