"""What the operators that read or write files say about paths."""

import bpy

# Scripts may begin a path with `//`, the folder of the .blend file. From 5.0 Blender warns them where that is not said.
RELATIVE = (
    {"PATH_SUPPORTS_BLEND_RELATIVE"}
    if "is_path_supports_blend_relative" in bpy.types.Property.bl_rna.properties
    else set()
)
