# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the installed add-on inside Blender; start them with run.py."""

import bpy
import pytest
from installed import addon
from support.tiers import (  # noqa: F401 - found by the path that installed adds; pytest finds the hooks here
    pytest_addoption,
    pytest_collection_modifyitems,
    pytest_configure,
    pytest_runtest_protocol,
)


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A folder in which commands run, and where Blender looks for relative paths."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PWD", str(tmp_path))
    return tmp_path


@pytest.fixture(autouse=True)
def empty_scene():
    """Every test starts with nothing: no objects, no kept analyses, paper defaults."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    addon("core.machine.cache").CACHE.clear()
