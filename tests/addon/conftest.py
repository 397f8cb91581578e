"""Tests of the installed add-on inside Blender; start them with run.py."""

import bpy
import pytest
from scene import addon


@pytest.fixture(autouse=True)
def empty_scene():
    """Every test starts with nothing: no objects, no kept analyses, paper defaults."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    addon("core.machine.cache").CACHE.clear()


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: minutes long; left out unless --slow is given")


def pytest_addoption(parser):
    parser.addoption("--slow", action="store_true", help="also run the tests marked slow")


def pytest_collection_modifyitems(config, items):
    if not config.getoption("--slow"):
        for item in items:
            if "slow" in item.keywords:
                item.add_marker(pytest.mark.skip(reason="minutes long; run with --slow"))
