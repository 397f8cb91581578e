# SPDX-License-Identifier: GPL-3.0-or-later
"""The scripts of the README and the user guide run as these pages say, and print what they promise."""

import re
import sys
from pathlib import Path

import pytest
from installed import MODULE, program, succeeded
from scene import compute, torus

ROOT = Path(__file__).resolve().parents[2]
PAGES = (ROOT / "README.md", ROOT / "docs" / "user_guide.md")
# Text that occurs in one script only -> the output of the script, and about how many facets it reports.
SCRIPTS = {
    "suzanne.ma": (r"Suzanne Medial Axis: (\d+) vertices, radius", None),
    "memory_limit": (None, 0),
    "primitive_torus_add": (r"\{'FINISHED'\} Torus Medial Axis (\d+)", None),
    "tight_cocone_surface": (r"scan Medial Axis (\d+) Inside from Tight Cocone", None),
}


def scripts():
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    return [block for block in blocks if "import bpy" in block]


def test_every_script_is_known():
    assert len(scripts()) == len(SCRIPTS)


SLOW = pytest.param("suzanne.ma", marks=pytest.mark.slow)


@pytest.mark.parametrize("word", [SLOW, *list(SCRIPTS)[1:]])
def test_script(tmp_path, word):
    """In a Blender of its own, by the command of the page."""
    (script,) = (text for text in scripts() if word in text)
    path = tmp_path / "script.py"
    path.write_text(script.replace('"medial_axis"', repr(MODULE)), encoding="utf-8")
    command = [program(), "--background", "--python-exit-code", "1", "--python", str(path)]
    out = succeeded(command, cwd=tmp_path)
    printed, count = SCRIPTS[word]
    if printed:
        found = re.search(printed, out)
        assert found, out
        number = int(found[1])
        assert number == pytest.approx(count, rel=0.05) if count else number > 0, number
    if word.endswith(".ma"):
        assert (tmp_path / word).stat().st_size > 0


def test_the_demo_prints_a_row_of_what_was_computed(monkeypatch):
    monkeypatch.setattr(sys, "path", [*sys.path, str(ROOT / "tests" / "demo")])
    from blender_demo import figures

    row = figures(MODULE, compute(torus(), form="CLEAN"))
    assert row["model"] == "Torus" and row["components"] == 1 and float(row["Delaunay s"]) >= 0.0
