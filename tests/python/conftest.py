"""Makes blender_addon/ importable as the package `medial_axis`, and gives tests its compiled module."""

import importlib.util
import os
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(
    os.environ.get("MEDIAL_AXIS_PACKAGE", ROOT / "blender_addon")
)  # or an installed copy
DATA = Path(os.environ.get("MEDIAL_AXIS_TEST_DATA", ROOT.parent / "shared" / "data"))

sys.path.insert(0, str(ROOT / "tests"))  # shapes, meshes and distance, shared with tests/benchmarks


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


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: minutes long; left out unless --slow is given")


def pytest_addoption(parser):
    parser.addoption("--slow", action="store_true", help="also run the tests marked slow")


def pytest_collection_modifyitems(config, items):
    if not config.getoption("--slow"):
        for item in items:
            if "slow" in item.keywords:
                item.add_marker(pytest.mark.skip(reason="minutes long; run with --slow"))


@pytest.fixture(scope="session")
def medial():
    """The compiled module. Its absence is a failure: there is nothing to test without it."""
    from medial_axis.core.machine import native

    return native.load()


@pytest.fixture(scope="session")
def data_file():
    """name -> path of a file of the optional data folder (MEDIAL_AXIS_TEST_DATA); skips by name when absent."""

    def find(name: str) -> Path:
        path = DATA / name
        if not path.is_file():
            pytest.skip(f"optional data file {name} is not in {DATA}")
        return path

    return find
