"""Tests of the installed add-on inside Blender; start them with run.py."""

import bpy
import pytest
from scene import addon


@pytest.fixture(autouse=True)
def empty_scene():
    """Every test starts with nothing: no objects, no kept analyses, paper defaults."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    addon("core.cache").CACHE.clear()
