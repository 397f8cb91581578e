# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the compiled module is loaded from, its file or a copy in memory, and what two of them do in one process.

Each is tried in a Python of its own.
"""

import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from medial_axis import __version__
from medial_axis.core.machine import native
from support.package import PACKAGE

needs_memory_files = pytest.mark.skipif(
    not hasattr(os, "memfd_create"), reason="the system has no files in memory"
)

START = f"""
import importlib.util, os, sys
spec = importlib.util.spec_from_file_location(
    "medial_axis", {str(PACKAGE / "__init__.py")!r}, submodule_search_locations=[{str(PACKAGE)!r}]
)
sys.modules["medial_axis"] = package = importlib.util.module_from_spec(spec)
spec.loader.exec_module(package)
from medial_axis.core.errors import NativeModuleError
from medial_axis.core.machine import native

def where():
    maps = open("/proc/self/maps").read()
    return [word for word in ("memfd:_medial", str(native.file())) if word in maps]

def refused(*_):
    raise PermissionError(1, "Operation not permitted")
"""


def said_by(script, *words):
    """The output of a script in a new Python."""
    command = [sys.executable, "-c", script, *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


def play(text):
    """The words that a script says in a new Python that has the add-on's package."""
    return said_by(START + textwrap.dedent(text)).split()


@pytest.fixture
def file():
    """The compiled module that this Python loads."""
    return str(native.file())


# Some systems forbid executing files in memory; here the loader finds an empty file instead.
EMPTY = "os.memfd_create = lambda name: os.open(os.devnull, os.O_RDWR)"


@needs_memory_files
@pytest.mark.parametrize(
    "before, copied",
    [
        ("pass", False),
        ("native.load_a_copy = True", True),
        ("os.memfd_create, native.load_a_copy = refused, True", False),
        (f"{EMPTY}; native.load_a_copy = True", False),
    ],
    ids=["plain", "a copy", "no files in memory", "no libraries in memory"],
)
def test_a_copy_in_memory_is_loaded_where_it_is_asked_for_and_can_be(file, before, copied):
    said = play(f"{before}; native.load(); print(*where())")
    assert said == (["memfd:_medial"] if copied else [file])


def test_system_without_files_in_memory_loads_the_file(file):
    said = play(
        """
        if hasattr(os, "memfd_create"):
            del os.memfd_create
        native.load_a_copy = True
        print(native.load().__file__)
        """
    )
    assert said == [file]


@pytest.mark.parametrize("copy", [False, True])
def test_message_of_a_broken_file_names_the_file(file, tmp_path, copy):
    (tmp_path / Path(file).name).write_bytes(b"no library")
    said = play(
        f"""
        import medial_axis.lib
        from pathlib import Path
        medial_axis.lib.__path__ = [{str(tmp_path)!r}]
        native.LIB, native.load_a_copy = Path({str(tmp_path)!r}), {copy}
        try:
            native.load()
        except NativeModuleError as error:
            print(error)
        assert "that loads" in native.problem(), "the panel must not try again at every draw"
        """
    )
    assert " ".join(said).startswith("Expected a compiled module for")
    assert str(tmp_path / Path(file).name) in " ".join(said) and "/proc/self" not in " ".join(said)


@pytest.mark.parametrize("taken", [True, False])
def test_module_of_a_wheel_is_taken_where_there_is_none_if_it_has_the_same_version(
    file, tmp_path, taken
):
    """Blender installs an extension's wheels into a folder of all extensions, where older ones may lie."""
    version = __version__ if taken else "0.0.1"
    info = tmp_path / f"medial_axis-{version}.dist-info"
    info.mkdir()
    head = "Metadata-Version: 2.1\nName: medial-axis\n"
    (info / "METADATA").write_text(f"{head}Version: {version}\n")
    library = tmp_path / "medial_axis" / "lib"
    library.mkdir(parents=True)
    module = library / Path(file).name
    module.write_bytes(Path(file).read_bytes())
    said = play(
        f"""
        from pathlib import Path
        native.LIB = Path({str(tmp_path / "none")!r})
        assert native.problem().startswith("Expected the compiled module")
        sys.path.append({str(tmp_path)!r})
        try:
            print(native.load().__file__)
        except NativeModuleError as error:
            print(error)
        """
    )
    expected = str(module) if taken else "Expected the compiled module for"
    assert " ".join(said).startswith(expected)


# Two packages, each with errors of its own.
TWO_PACKAGES = """
import importlib.util, sys
import numpy as np

def load(name, folder):
    spec = importlib.util.spec_from_file_location(
        name, folder + "/__init__.py", submodule_search_locations=[folder])
    package = sys.modules[name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(package)
    return package

points = np.random.default_rng(0).normal(size=(2000, 3))
points *= np.array([1.0, 0.7, 0.4]) / np.linalg.norm(points, axis=1)[:, None]
one, other = load("medial_axis", sys.argv[1]), load("another_name", sys.argv[2])
axes = [package.compute(points).axis for package in (one, other)]
assert axes[0].facets > 30 and axes[0].vertices.tobytes() == axes[1].vertices.tobytes()
for package in (one, other, one):
    try:
        package.compute(points * (1, 1, 0))
    except package.DegenerateInputError:
        continue
    raise SystemExit("an error of another package")
print("both work")
"""


def test_two_packages_live_side_by_side(tmp_path):
    """Blender may have the extension and pip a package: two folders, two names."""
    copy = shutil.copytree(PACKAGE, tmp_path / "copy", ignore=shutil.ignore_patterns("__pycache__"))
    assert said_by(TWO_PACKAGES, PACKAGE, copy) == "both work\n"


TRY = """
import sys, _xxsubinterpreters as interpreters
other = interpreters.create()
load = "import sys; sys.path.insert(0, {!r}); import _medial".format(sys.argv[1])
try:
    interpreters.run_string(other, load)
except interpreters.RunFailedError as error:
    print(error)
exec(load)
print(sys.modules["_medial"].__name__)
"""


@pytest.mark.skipif(sys.version_info >= (3, 13), reason="_xxsubinterpreters has another name")
def test_subinterpreters_are_refused(medial):
    refused, name = said_by(TRY, Path(medial.__file__).parent).splitlines()
    assert "Expected the main interpreter of the process, found a subinterpreter" in refused
    assert name == "_medial"
