# SPDX-License-Identifier: GPL-3.0-or-later
"""The package as pip builds and installs it: an sdist, a wheel of it, and the same bytes as the add-on.

Compiles the whole core in a virtual environment of its own; skipped by name where pip cannot get the build backend.
"""

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile

import pytest
from support.package import ROOT

ADDON = ROOT / "blender_addon"
VERSION = tomllib.loads((ADDON / "blender_manifest.toml").read_text())["version"]
CORE = {
    path.relative_to(ADDON).as_posix()
    for folder in ("commands", "core")
    for path in (ADDON / folder).rglob("*.py")
}
FRONT = {"__init__.py", "__main__.py", "cli.py", "console.py", "library.py", "py.typed"}

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("wheel")]

BUILD_SDIST = "import sys, scikit_build_core.build as b; print(b.build_sdist(sys.argv[1]))"


def run(*words, **options):
    environment = {**os.environ, "CMAKE_BUILD_PARALLEL_LEVEL": "2", "PYTHONNOUSERSITE": "1"}
    environment.pop("PYTHONPATH", None)
    return subprocess.run(
        list(map(str, words)), capture_output=True, text=True, env=environment, **options
    )


def said(*words, **options):
    done = run(*words, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """The programs of a fresh virtual environment with what pyproject.toml asks for to build."""
    folder = tmp_path_factory.mktemp("environment")
    if run(sys.executable, "-m", "venv", folder).returncode != 0:
        pytest.skip("this Python makes no virtual environments (python3-venv is not installed)")
    programs = folder / "bin"
    needed = ("scikit-build-core>=0.10", "pybind11>=2.10", "numpy")
    if run(programs / "pip", "install", "-q", *needed).returncode != 0:
        pytest.skip(f"pip cannot get {', '.join(needed)}")
    return programs


@pytest.fixture(scope="module")
def sdist(environment, tmp_path_factory):
    folder = tmp_path_factory.mktemp("sdist")
    said(environment / "python", "-c", BUILD_SDIST, folder, cwd=ROOT)
    (archive,) = folder.iterdir()
    return archive


@pytest.fixture(scope="module")
def wheel(environment, sdist, tmp_path_factory):
    """The wheel built from the sdist, so that it needs nothing else."""
    folder = tmp_path_factory.mktemp("wheel")
    options = ("--no-build-isolation", "--no-deps", "-w", folder)
    said(environment / "pip", "wheel", *options, sdist)
    (archive,) = folder.iterdir()
    return archive


@pytest.fixture(scope="module")
def installed(environment, wheel):
    said(environment / "pip", "install", "--no-deps", wheel)
    return environment


def test_sdist_holds_what_is_needed_and_nothing_else(sdist):
    assert sdist.name == f"medial_axis-{VERSION}.tar.gz"
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    native = [p for p in (ROOT / "native").rglob("*") if p.suffix in {".h", ".cpp", ".cmake"}]
    lists = [*(ROOT / "native").rglob("CMakeLists.txt"), ROOT / "native/python/_medial.pyi"]
    expected = {path.relative_to(ROOT).as_posix() for path in (*native, *lists)}
    expected -= {"native/mingw.cmake", "native/zig.cmake"}  # for other systems
    expected |= {"native/python/exports.map", "native/python/docstrings.py"}
    expected |= {"blender_addon/blender_manifest.toml"}
    expected |= {f"blender_addon/{name}" for name in CORE | FRONT}
    expected |= {"CMakeLists.txt", "LICENSE", "README.md", "pyproject.toml", "PKG-INFO"}
    assert names == expected


def test_wheel_is_the_add_on_without_its_blender_side(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
        for name in CORE | FRONT:
            assert archive.read(f"medial_axis/{name}") == (ADDON / name).read_bytes()
        metadata = archive.read(f"medial_axis-{VERSION}.dist-info/METADATA").decode()
    package = {name for name in names if ".dist-info/" not in name}
    (module,) = {name for name in package if name.startswith("medial_axis/lib/_medial.cpython-")}
    stub = "medial_axis/lib/_medial.pyi"
    assert package == {module, stub, *(f"medial_axis/{name}" for name in CORE | FRONT)}
    assert f"medial_axis-{VERSION}.dist-info/licenses/LICENSE" in names
    for line in ("Name: medial-axis", f"Version: {VERSION}", "License: GPL-3.0-or-later"):
        assert line in metadata.splitlines()
    assert "Requires-Dist: numpy" in metadata and "Requires-Python: >=3.11" in metadata


def test_command(installed, tmp_path):
    assert said(installed / "medial-axis", "--version") == f"medial_axis {VERSION}\n"
    (tmp_path / "box.off").write_text(
        "OFF\n8 6 0\n0 0 0\n1 0 0\n1 2 0\n0 2 0\n0 0 3\n1 0 3\n1 2 3\n0 2 3\n"
        "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
    )
    text = said(installed / "medial-axis", "box.off", "box.ma", cwd=tmp_path)
    assert re.fullmatch(r"box\.ma: [\d,]+ facets, done in .* s\n", text)
    assert (tmp_path / "box.ma").stat().st_size > 1000
    assert run(installed / "medial-axis", "none.off", "a.ma", cwd=tmp_path).returncode == 3
