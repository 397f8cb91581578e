# SPDX-License-Identifier: GPL-3.0-or-later
"""The words of the window: one line that begins with what to do or what was found."""

import re
from pathlib import Path

import blf
import bpy
import pytest
from installed import addon
from scene import added
from test_rows import Layout, seen

FLAT = "Expected faces that span a volume, found all of them in one plane; give them thickness"
OPEN = (
    "Expected faces that bound a solid, found an open sheet (320 open edges); give it thickness (a "
    "Solidify modifier), or choose Side Both, or Inside Decided By Normals for what lies behind it"
)
OTHER = "Expected a mesh of this file, found another object; convert it to a mesh, or link it"
BARE = "Expected a surface with faces, found one without"
PRESS = "Press Measure Thickness to apply this"


@pytest.mark.parametrize(
    ("kind", "sentence", "line"),
    [
        ("FONT", FLAT, "This text is flat: give it Extrude."),
        ("MESH", OPEN, "This mesh is open: add Solidify, or choose Side: Both."),
        ("MESH", OTHER, "Convert it to a mesh."),
        ("MESH", BARE, "This needs a surface with faces."),
        ("MESH", PRESS, PRESS),
    ],
)
def test_sentences_of_the_library_become_one_line(kind, sentence, line):
    assert addon("ui.base.plain_words").in_one_line(sentence, kind) == line


def test_the_kind_and_the_name_are_those_of_the_object():
    words, name = addon("ui.base.plain_words"), added("object.text").name
    assert words.in_one_line(f"'{name}': {FLAT}") == "This text is flat: give it Extrude."
    other = "Expected points, found none; add some, or change the modifiers that remove them"
    assert words.in_one_line(f"'{name}': {other}") == f"'{name}': Add some."


def test_no_error_of_the_sources_shows_its_grammar():
    """Every sentence that the sources write as one text: in the window, nothing of it reads Expected, found."""
    sources = Path(addon().__file__).parent.rglob("*.py")
    text = "".join(path.read_text(encoding="utf-8") for path in sources)
    found = re.findall(r'"(Expected [^"{]+[^"{ ])"\n', text)
    assert len(found) > 3
    for sentence in found:
        line = addon("ui.base.plain_words").in_one_line(sentence)
        assert not line.startswith("Expected"), sentence


def test_warnings_are_what_was_found():
    warned = addon("ui.base.plain_words").warned
    assert warned("the surface is open at 84 edges: inside was guessed") == "Openings were closed"


def test_no_verdict_is_cut_off_in_a_sidebar_as_wide_as_it_is_at_first(monkeypatch):
    figures, layout, context = addon("ui.axis.figures"), Layout(), seen(width=220)
    monkeypatch.setattr(figures, "in_short", lambda words: words)
    for words in addon("core.axis.verdict")._IN_SHORT.values():
        result = {"ma_light": "LOOK", "ma_verdict": words, "ma_betti": (673, 4195, 12)}
        figures._draw_verdict(context, layout, result)
        figures._draw_pieces(context, layout, result)
    blf.size(0, bpy.context.preferences.ui_styles[0].widget.points)
    drawn = [text for row in layout.rows for text in row if " " in text]
    assert max(blf.dimensions(0, text)[0] for text in drawn) <= 138  # pixels


def test_a_computation_says_what_it_does_in_one_word():
    doing = addon("ui.base.plain_words").doing
    done = [doing(stage) for stage in ("Sharp edges", "Crisp places", "Fire", "Wires")]
    assert done == ["Sampling", "Building", "Cleaning", "Drawing"]
    assert doing("1 of 2: Poles") == "1 of 2: Building" and doing("Pass 2: Poles") == "Building"
