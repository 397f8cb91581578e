# SPDX-License-Identifier: GPL-3.0-or-later
"""Two copies of the compiled module in one process, as of an installed package and of an add-on: each for itself."""

import shutil
import subprocess
import sys
from pathlib import Path

import medial_axis

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


def run(code, *words):
    command = [sys.executable, "-c", code, *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "both work\n"


def test_two_packages_live_side_by_side(tmp_path):
    """Blender may have the extension and pip a package: two folders, two names."""
    folder = Path(medial_axis.__file__).parent
    copy = shutil.copytree(folder, tmp_path / "copy", ignore=shutil.ignore_patterns("__pycache__"))
    run(TWO_PACKAGES, folder, copy)
