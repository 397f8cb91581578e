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
if not any(os.path.exists(word.partition("::")[0]) for word in arguments):
    # A word of -k may be too long for a name, at which exists() of a Path would raise. The folder stands first: pytest
    # reads its words before it knows the options of conftest.py, takes the value of an unknown one for a place, and
    # then reads no further place after another option.
    arguments.insert(0, str(HERE))
options = ["-q", "-p", "no:cacheprovider", f"--ignore={HERE / 'gui'}"]
sys.exit(pytest.main([*options, *arguments]))
