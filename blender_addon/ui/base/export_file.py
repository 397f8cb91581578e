# SPDX-License-Identifier: GPL-3.0-or-later
"""The base of operators that write one file of several formats, chosen by name or from a list."""

import os
from pathlib import Path

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper

from .paths import RELATIVE


class ExportFile(ExportHelper):
    """Keeps the name of the file and the property `file_format` of the operator together.

    A subclass has `extensions`, from the formats to what names end in, and `default_name(context)`.
    """

    filepath: StringProperty(name="File Path", subtype="FILE_PATH", options=RELATIVE)

    @property
    def filename_ext(self) -> str:
        return self.extensions[self.file_format]

    @property
    def chosen_path(self) -> str:
        """The absolute path of the file; without an extension it gets that of the format."""
        path = bpy.path.abspath(self.filepath)
        return path if Path(path).suffix else path + self.filename_ext

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if not self.filepath:
            folder = os.path.dirname(bpy.data.filepath)
            name = bpy.path.clean_name(self.default_name(context))
            self.filepath = os.path.join(folder, name + self.filename_ext)
        self._shown_format = self.file_format
        return super().invoke(context, event)

    def check(self, _context: bpy.types.Context) -> bool:
        """Keep name and format together while the file browser is open: what was changed last wins."""
        # Not a Path, which takes Blender's // for a network folder of Windows
        path, (stem, suffix) = self.filepath, os.path.splitext(self.filepath)
        known = {ending: name for name, ending in self.extensions.items()}
        chosen, self._shown_format = self.file_format != self._shown_format, self.file_format
        if not chosen and suffix.lower() in known:
            self.file_format = self._shown_format = known[suffix.lower()]
            return False
        self.filepath = (stem if suffix.lower() in known else path) + self.filename_ext
        return self.filepath != path
