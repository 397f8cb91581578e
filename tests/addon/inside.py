# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender: enables the installed add-on and hands over to pytest."""

import os
import sys
from pathlib import Path

import bpy
import pytest

HERE = Path(__file__).resolve().parent

bpy.ops.preferences.addon_enable(module=os.environ["MEDIAL_AXIS_MODULE"])
arguments = sys.argv[sys.argv.index("--") + 1 :]
if not any(Path(word.partition("::")[0]).exists() for word in arguments):
    arguments.append(str(HERE))
options = ["-q", "-p", "no:cacheprovider", f"--ignore={HERE / 'gui'}"]
sys.exit(pytest.main([*options, *arguments]))
