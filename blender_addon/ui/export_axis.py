# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Export > Medial Axis: the active object's medial axis as a file."""

import os
from pathlib import Path

import bpy
from bpy.props import EnumProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..bridge.read_axis import find_axis, read_axis, world_matrix
from ..core.axis.medial_axis import MedialAxis
from ..core.errors import MedialAxisError
from ..core.files.write import FORMATS, export_axis
from .paths import RELATIVE
from .translation import say

_EXTENSIONS = {suffix[1:].upper(): suffix for suffix in FORMATS}


class EXPORT_SCENE_OT_medial_axis(bpy.types.Operator, ExportHelper):
    bl_idname = "export_scene.medial_axis"
    bl_label = "Export Medial Axis"
    bl_description = (
        "Write the medial axis of the active object, with its radii, in world coordinates"
    )
    bl_options = {"PRESET"}

    filepath: StringProperty(name="File Path", subtype="FILE_PATH", options=RELATIVE)
    filter_glob: StringProperty(
        default=";".join(f"*{suffix}" for suffix in FORMATS), options={"HIDDEN"}
    )
    file_format: EnumProperty(
        name="Format",
        description="Kind of file, where the file name does not say it",
        items=[(name, suffix, FORMATS[suffix].label) for name, suffix in _EXTENSIONS.items()],
        default="MA",
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if find_axis(context.active_object) is None:
            cls.poll_message_set(
                say("Select a medial axis, or an object whose medial axis was computed before")
            )
            return False
        return True

    @property
    def filename_ext(self) -> str:
        return _EXTENSIONS[self.file_format]

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if not self.filepath:
            folder = os.path.dirname(bpy.data.filepath)
            name = bpy.path.clean_name(find_axis(context.active_object).name)
            self.filepath = os.path.join(folder, name + self.filename_ext)
        self._shown_format = self.file_format
        return super().invoke(context, event)

    def check(self, context: bpy.types.Context) -> bool:
        """Keep name and format together while the file browser is open: what was changed last wins."""
        # Not a Path, which takes Blender's // for a network folder of Windows
        path, (stem, suffix) = self.filepath, os.path.splitext(self.filepath)
        chosen, self._shown_format = self.file_format != self._shown_format, self.file_format
        if not chosen and suffix.lower() in FORMATS:
            self.file_format = self._shown_format = suffix[1:].upper()
            return False
        self.filepath = (stem if suffix.lower() in FORMATS else path) + self.filename_ext
        return self.filepath != path

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.view_layer.update()  # scripts may have moved the object
        result = find_axis(context.active_object)
        path = bpy.path.abspath(self.filepath)
        if not Path(path).suffix:
            path += self.filename_ext
        try:
            axis = read_axis(result)
            written = export_axis(axis, path, world_matrix(result))
        except MedialAxisError as error:
            self.report({"ERROR"}, say(error))
            return {"CANCELLED"}
        self.report({"INFO"}, say(f"Wrote {_size(axis)} to '{written.name}'"))
        return {"FINISHED"}


def _size(axis: MedialAxis) -> str:
    if not len(axis.edges):
        return f"{axis.facets:,} facets"
    return f"{axis.facets:,} facets and {len(axis.edges):,} edges"


def menu_func_export(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    suffixes = "/".join(FORMATS)
    self.layout.operator(EXPORT_SCENE_OT_medial_axis.bl_idname, text=f"Medial Axis ({suffixes})")


CLASSES = (EXPORT_SCENE_OT_medial_axis,)


def register() -> None:
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.TOPBAR_MT_file_export.append(menu_func_export)


def unregister() -> None:
    bpy.types.TOPBAR_MT_file_export.remove(menu_func_export)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
