# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of docs/libraries.md are those that are compiled and run elsewhere, and print what the page says."""

import os
import re
import subprocess
import sys
from pathlib import Path

import medial_axis
import pytest
from support.package import ROOT

pytestmark = pytest.mark.docs

PAGE = (ROOT / "docs" / "libraries.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
CONSUMER = ROOT / "tests" / "consumer"


def block(kind, number=0):
    return [text for name, text in BLOCKS if name == kind][number]


def test_example_for_python_prints_what_the_page_says(tmp_path):
    (tmp_path / "example.py").write_text(block("python"))
    package = Path(medial_axis.__file__).parent
    (tmp_path / "medial_axis").symlink_to(package, target_is_directory=True)
    options = {"env": {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}, "text": True}
    command = [sys.executable, "example.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, **options)
    assert done.stdout == block("text"), done.stderr
    assert (tmp_path / "ellipsoid.ply").stat().st_size > 10_000


def test_example_for_cpp_is_the_one_that_is_compiled():
    """tests/python/test_consumer.py compares its output with the page."""
    licence, source = (CONSUMER / "main.cpp").read_text().split("\n", 1)
    assert licence.startswith("// SPDX") and block("cpp") == source
    lists = (CONSUMER / "CMakeLists.txt").read_text()
    assert all(line in lists for line in block("cmake").splitlines())


def test_page_names_everything_that_is_public():
    headers = {path.name for path in (ROOT / "native" / "include" / "medial").iterdir()}
    assert set(re.findall(r"<medial/(\w+\.h)>", PAGE)) == headers
    functions = {name for name in medial_axis.__all__ if name.islower()}
    assert functions <= set(re.findall(r"^\| `(\w+)\(", PAGE, re.MULTILINE))
