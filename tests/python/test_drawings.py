# SPDX-License-Identifier: GPL-3.0-or-later
"""The drawings of docs/algorithm.md are what their script draws of the module's results."""

import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tests" / "benchmarks" / "algorithm_pictures.py"
NAMES = ("cell", "theta_rho", "peeling")


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """In a process of its own: the script loads the package by itself."""
    folder = tmp_path_factory.mktemp("drawings")
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    words = [sys.executable, SCRIPT, "--output", folder]
    subprocess.run(words, check=True, env=environment)
    return folder


def elements(path):
    return list(ElementTree.parse(path).iter())


@pytest.mark.parametrize("name", NAMES)
def test_drawing_is_as_its_script_draws_it(drawn, name):
    """Words and numbers of words to the letter; of lines how many there are of each kind."""
    new, old = (elements(folder / f"{name}.svg") for folder in (drawn, ROOT / "docs/pictures"))
    assert [e.text for e in new] == [e.text for e in old]
    assert [e.tag for e in new] == [e.tag for e in old]
