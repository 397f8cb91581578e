# SPDX-License-Identifier: GPL-3.0-or-later
"""Paths, as the operators that read or write files need them."""

import os

import bpy

# Scripts may begin a path with `//`, the folder of the .blend file. From 5.0 Blender warns them where that is not said.
RELATIVE = (
    {"PATH_SUPPORTS_BLEND_RELATIVE"}
    if "is_path_supports_blend_relative" in bpy.types.Property.bl_rna.properties
    else set()
)


def chosen_files(operator):
    """Absolute paths of what was chosen in a file browser, or by a script: several files of a folder, or one."""
    # Not Paths, which take Blender's // for a network folder of Windows
    folder = bpy.path.abspath(operator.directory)
    names = [element.name for element in operator.files if element.name]
    paths = [os.path.join(folder, name) for name in names]
    return paths or [bpy.path.abspath(operator.filepath)]
