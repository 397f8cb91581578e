# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on that is installed in this Blender, and what this Blender can do."""

import ctypes
import importlib
import os
import subprocess
import sys
from pathlib import Path

import bpy
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # for what other tests share

MODULE = os.environ["MEDIAL_AXIS_MODULE"]


def program():
    """The Blender that runs this, to be started once more."""
    if not bpy.app.binary_path:
        pytest.skip("this is Blender as a module; it has no program")
    return bpy.app.binary_path


def succeeded(command, **options):
    """Run another program, which must succeed; returns the text that it prints."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, **options)
    assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
    return done.stdout


def addon(path=""):
    """A module of the installed add-on, such as addon('core.axis.compute')."""
    return importlib.import_module(f"{MODULE}.{path}" if path else MODULE)


def in_wine():
    """Whether this is no real Windows."""
    return sys.platform == "win32" and hasattr(ctypes.windll.ntdll, "wine_get_version")


renders = pytest.mark.skipif(in_wine(), reason="Blender does not render in Wine")
