"""Runs inside Blender before 4.2: installs and enables the zip given after `--`, for good."""

import sys

import bpy

archive = sys.argv[sys.argv.index("--") + 1]
bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
bpy.ops.preferences.addon_enable(module="medial_axis")
if "medial_axis" not in bpy.context.preferences.addons:
    raise SystemExit("the add-on could not be enabled; see above")
bpy.ops.wm.save_userpref()
