# SPDX-License-Identifier: GPL-3.0-or-later
"""The drawings of the docs are what their scripts draw of the module's results."""

import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "pictures"
NAMES = {
    "algorithm_pictures": ("cell", "theta_rho", "peeling"),
    "stage_pictures": ("stage_fringe", "stage_fire", "stage_wires", "stage_crisp"),
    "section_pictures": (
        "stage_sampling",
        "stage_delaunay",
        "stage_inside",
        "stage_selection",
        "stage_labels",
    ),
    "mid_surface_picture": ("mid_surface",),
}
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
# Another processor's last bit may turn a rounded coordinate, and the smoothed ends of a wire a little more.
PIXELS = 1.5


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """In processes of their own: the scripts load the package by themselves."""
    folder = tmp_path_factory.mktemp("drawings")
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    for script in NAMES:
        words = [sys.executable, ROOT / "lab/benchmarks" / f"{script}.py", "--output", folder]
        subprocess.run(words, check=True, env=environment)
    return folder


def elements(path):
    return list(ElementTree.parse(path).iter())


def places(element):
    """All coordinates and lengths of an element."""
    kinds = ("d", "x", "y", "cx", "cy", "r")
    return [float(n) for kind in kinds for n in NUMBER.findall(element.get(kind, ""))]


def assert_same_place(one, other):
    """A line may also be drawn from its other end, for a last bit decides where the cut of a facet begins."""
    new, old = places(one), places(other)
    is_line = one.tag.endswith("path") and len(new) == len(old) == 4
    turned = new[2:] + new[:2] if is_line else new
    assert any(np.allclose(way, old, rtol=0, atol=PIXELS) for way in (new, turned)), (new, old)


@pytest.mark.parametrize("name", [name for names in NAMES.values() for name in names])
def test_drawing_is_as_its_script_draws_it(drawn, name):
    """Words and colours to the letter; places to a pixel or so."""
    new, old = (elements(folder / f"{name}.svg") for folder in (drawn, PICTURES))
    assert [e.text for e in new] == [e.text for e in old]
    assert [(e.tag, e.get("stroke")) for e in new] == [(e.tag, e.get("stroke")) for e in old]
    for one, other in zip(new, old, strict=True):
        assert_same_place(one, other)


def test_plot_of_the_convergence_shows_its_rows(tmp_path):
    words = ["--draw", "--picture", tmp_path / "convergence.svg"]
    subprocess.run([sys.executable, ROOT / "lab/benchmarks/convergence.py", *words], check=True)
    drawn = (tmp_path / "convergence.svg").read_text(encoding="utf-8")
    assert drawn == (PICTURES / "convergence.svg").read_text(encoding="utf-8")


def test_drawings_without_a_script_are_named():
    """Race plots are made by the benchmark's page; the rooms have no script."""
    known = {name for names in NAMES.values() for name in names}
    others = {"convergence", "race_mean", "race_missed_mean", "rooms"}
    assert {path.stem for path in PICTURES.glob("*.svg")} == known | others
