# SPDX-License-Identifier: GPL-3.0-or-later
"""The types that the package promises (py.typed), as the type checker of a program reads them.

It is mypy; skipped by name where there is none. `build_addon.py test --only lint` checks the package itself.
"""

import shutil
import subprocess
import sys

import pytest
from support.package import ROOT

ADDON = ROOT / "blender_addon"

RIGHT = """
import numpy as np
from numpy.typing import NDArray

import medial_axis

shape = medial_axis.read("bunny.ply")
found: medial_axis.Computation = medial_axis.compute(shape.points, shape.triangles, side="inner")
radius: NDArray[np.float64] = found.axis.radius
warnings: tuple[str, ...] = found.warnings
fewer: medial_axis.MedialAxis = medial_axis.extract(found, theta=0.6)
print(medial_axis.write(fewer, "bunny.ma").name, radius.max(), medial_axis.__version__.split("."))
try:
    medial_axis.reconstruct([[0.0, 0.0, 0.0]])
except medial_axis.DegenerateInputError as error:
    print(str(error))
"""
WRONG = """
import medial_axis

medial_axis.compute()
medial_axis.write("bunny.ma", 3)
medial_axis.read("bunny.ply").volume.radius
medial_axis.comptue
"""


@pytest.fixture(scope="module")
def check(tmp_path_factory):
    """(words) -> what mypy says where the package is installed as the wheel has it."""
    program = shutil.which("mypy")
    if program is None:
        pytest.skip("mypy is not installed")
    folder = tmp_path_factory.mktemp("installed")
    package = folder / "medial_axis"
    shutil.copytree(ADDON / "core", package / "core")
    for path in (*ADDON.glob("*.py"), ADDON / "py.typed"):
        shutil.copy(path, package)
    (package / "lib").mkdir()
    shutil.copy(ROOT / "native" / "python" / "_medial.pyi", package / "lib")

    def run(*words):
        command = [program, "--python-executable", sys.executable, *words]
        done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
        assert not done.stderr, done.stderr
        return done.stdout

    return run


@pytest.mark.parametrize("code, errors", [(RIGHT, []), (WRONG, [4, 5, 6, 7])])
def test_types_as_a_program_sees_them(check, tmp_path, code, errors):
    source = tmp_path / "program.py"
    source.write_text(code)
    said = check("--config-file=", "--strict", "--follow-imports=silent", str(source))
    found = [int(line.split(":")[1]) for line in said.splitlines() if ": error:" in line]
    assert sorted(set(found)) == errors, said
