# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender before 4.2, or with the bpy module: installs and enables the zip given after `--`, for good."""

import sys

import bpy

archive = sys.argv[sys.argv.index("--") + 1]
if bpy.app.version >= (4, 2, 0):
    bpy.ops.extensions.package_install_files(
        filepath=archive, repo="user_default", enable_on_install=True
    )
else:
    bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
    bpy.ops.preferences.addon_enable(module="medial_axis")
if not any(addon.module.endswith("medial_axis") for addon in bpy.context.preferences.addons):
    raise SystemExit("the add-on could not be enabled; see above")
bpy.ops.wm.save_userpref()
