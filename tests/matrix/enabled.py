# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender with a person's settings: the extension is enabled and computes; its version is written as JSON.

Arguments: the name of its module, and the file for the answer.
"""

import json
import re
import sys
from pathlib import Path

import bpy

module, answer = sys.argv[sys.argv.index("--") + 1 :]
if module not in bpy.context.preferences.addons:
    raise SystemExit(f"Expected {module} to be enabled, found it is not")
bpy.ops.mesh.primitive_cube_add()
if bpy.ops.object.medial_axis() != {"FINISHED"} or not bpy.context.object.data.polygons:
    raise SystemExit("Expected the axis of a cube, found none")
manifest = Path(sys.modules[module].__file__).with_name("blender_manifest.toml").read_text()
version = re.search(r'^version = "(.+)"', manifest, re.MULTILINE)[1]
Path(answer).write_text(json.dumps({"version": version}))
