# SPDX-License-Identifier: GPL-3.0-or-later
"""`blender --command medial_axis`, in Blenders that have such commands: from 4.2."""

import bpy

from ... import cli

_command = None


def register():
    global _command
    if hasattr(bpy.utils, "register_cli_command"):
        _command = bpy.utils.register_cli_command("medial_axis", cli.main)


def unregister():
    global _command
    if _command is not None:
        bpy.utils.unregister_cli_command(_command)
        _command = None
