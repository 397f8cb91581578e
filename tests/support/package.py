# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes blender_addon/ importable as the package `medial_axis`, and gives tests its compiled module.

The conftest.py of a folder of tests imports everything here: fixtures, and hooks of pytest.
"""

import importlib.util
import os
import sys
from pathlib import Path

import pytest

from . import study as study_module
from .data import DATA
from .sampled import Sampled
from .tiers import (  # noqa: F401 - hooks, which pytest finds in a conftest that imports them
    pytest_addoption,
    pytest_collection_modifyitems,
    pytest_configure,
    pytest_runtest_protocol,
)

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(
    os.environ.get("MEDIAL_AXIS_PACKAGE", ROOT / "blender_addon")
)  # or an installed copy


def _register_package() -> None:
    """The add-on's folder under the name it has when it is installed."""
    if "medial_axis" in sys.modules:
        return
    spec = importlib.util.spec_from_file_location(
        "medial_axis", PACKAGE / "__init__.py", submodule_search_locations=[str(PACKAGE)]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules["medial_axis"] = package
    spec.loader.exec_module(package)


_register_package()


@pytest.fixture(scope="session")
def medial():
    """The compiled module. Its absence is a failure: there is nothing to test without it."""
    from medial_axis.core.machine import native

    return native.load()


@pytest.fixture(scope="session")
def study():
    """The module that is not shipped: all of `medial`, and what only tests call. Its absence is a failure."""
    return study_module.load()


@pytest.fixture(scope="module")
def sampled(medial):
    """(name, n, seed, noise) -> shape, analysis, hierarchy of a shape with a known axis, each made once."""
    return Sampled(medial)


@pytest.fixture(scope="session")
def data_file():
    """name -> path of a file of the optional data folder (MEDIAL_AXIS_TEST_DATA); skips by name when absent."""

    def find(name: str) -> Path:
        path = DATA / name
        if not path.is_file():
            pytest.skip(f"optional data file {name} is not in {DATA}")
        return path

    return find
