# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual that comes with the add-on: buttons, and Online Manual in Blender's context menus."""

from pathlib import Path

import bpy

_FOLDER = Path(__file__).resolve().parents[2] / "manual"
_PAGES = {
    "tutorial.html": "Tutorial",
    "user_guide.html": "User Guide",
    "troubleshooting.html": "Troubleshooting",
    "command_line.html": "Command Line",
}
# Blender's names of operators and properties, in lower case, and the places of the manual that describe them.
_PLACES = (
    ("bpy.ops.object.medial_axis_sampling_report*", "user_guide.html#report-sampling"),
    ("bpy.ops.object.medial_axis_nodes*", "user_guide.html#live-in-geometry-nodes"),
    ("bpy.ops.object.medial_axis_reduce*", "small_mesh.html"),
    ("bpy.ops.object.medial_axis_to_curve*", "user_guide.html#forms"),
    ("bpy.ops.object.medial_axis_rebuild*", "user_guide.html#rebuild-solid"),
    ("bpy.ops.wm.medial_axis_asset_library*", "user_guide.html#live-in-geometry-nodes"),
    ("bpy.ops.object.medial_axis_sequence*", "user_guide.html#animation"),
    ("bpy.ops.import_scene.medial_axis_sequence*", "user_guide.html#animation"),
    ("bpy.types.scene.medial_axis_folder*", "user_guide.html#animation"),
    ("bpy.ops.object.medial_axis*", "user_guide.html#the-settings"),
    ("bpy.types.medialaxispanelsettings*", "user_guide.html#the-settings"),
    ("bpy.ops.object.tight_cocone_surface*", "user_guide.html#reconstruct-surface"),
    ("bpy.ops.import_mesh.points_*", "user_guide.html#scans-and-point-clouds"),
    ("bpy.ops.export_scene.medial_axis*", "user_guide.html#exporting"),
    ("bpy.types.medialaxispreferences*", "user_guide.html#preferences"),
    ("bpy.ops.wm.medial_axis_*", "user_guide.html#preferences"),
)


def has(page):
    """Whether a page of the manual is there; a copy of the sources has none."""
    return (_FOLDER / page).is_file()


def address(place):
    """The address of a place in the manual, such as 'user_guide.html#sampling'."""
    return f"{_FOLDER.as_uri()}/{place}"


def draw_manual(layout):
    """A button for each page that is there; a copy of the sources has none."""
    row = layout.row()
    for name, label in _PAGES.items():
        if has(name):
            row.operator("wm.url_open", text=label, icon="HELP").url = address(name)


def places():
    """As `bpy.utils.register_manual_map` wants them."""
    return f"{_FOLDER.as_uri()}/", _PLACES if _FOLDER.is_dir() else ()


def register():
    bpy.utils.register_manual_map(places)


def unregister():
    bpy.utils.unregister_manual_map(places)
