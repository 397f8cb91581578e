# SPDX-License-Identifier: GPL-3.0-or-later
"""The traffic light of a computation, and the sentence next to it."""

import re
from pathlib import Path

import pytest
from medial_axis.core.axis import topology
from medial_axis.core.axis import verdict as verdicts
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.axis.verdict import Light, in_short, plainly, verdict
from medial_axis.core.errors import Severe
from medial_axis.core.settings import SamplingMode, Settings
from medial_axis.core.shape.shape import Shape
from support.meshes import icosphere
from support.thick_meshes import block

CUBE, FACES = block(2.0, 2.0, 2.0)


def computed(points, triangles, **settings):
    return compute_axis(Shape(points, triangles), Settings(**settings))


def seen(found):
    return verdict(found.chosen, found.warnings)


def test_a_cube_is_good_and_the_sentence_says_why_it_was_sampled():
    found = computed(CUBE, FACES)
    said = f"Sampled {len(found.chosen.samples.points):,} points, "
    assert seen(found).light is Light.GOOD
    assert seen(found).sentence == f"{said}because the mesh has too few vertices."


def test_vertices_and_samples_that_were_asked_for():
    vertices = computed(*icosphere(4), sampling=SamplingMode.VERTICES)
    assert plainly(vertices.chosen) == "Used the 2,562 vertices as they are."
    faces = computed(CUBE, FACES, sampling=SamplingMode.SURFACE, samples=1000)
    count = len(faces.chosen.samples.points)
    assert plainly(faces.chosen) == f"Sampled {count:,} points of the surface."


def test_an_open_mesh_is_to_be_looked_at():
    found = computed(CUBE, FACES[:-1])
    assert found.warnings and seen(found).light is Light.LOOK
    assert seen(found).sentence.lower().startswith(found.warnings[0][:20].lower())


def test_samples_that_are_too_sparse_are_looked_at():
    found = computed(*icosphere(1), sampling=SamplingMode.VERTICES, epsilon=0.05)
    assert seen(found).light is Light.LOOK
    assert "so the axis may be wrong" in seen(found).sentence


@pytest.mark.parametrize("order", [1, -1])
def test_severe_warnings_come_first(order):
    found = computed(CUBE, FACES)
    warnings = ["something was assumed", Severe("it is wrong")][::order]
    assert verdict(found.chosen, warnings).sentence == "It is wrong."


def test_a_few_words_stand_for_sentences_that_exist():
    """Each part that is looked for is in a sentence of the sources, and the words fit into a row of the panel."""
    core = Path(verdicts.__file__).parents[1]
    files = [*core.glob("samples/*.py"), *core.glob("shape/*.py"), *core.glob("axis/*_warnings.py")]
    texts = " ".join(path.read_text(encoding="utf-8") for path in files)
    texts = re.sub(r"[\"']\s*f?[\"']", "", texts).lower()  # sentences go over several lines
    parts = verdicts._IN_SHORT
    assert not [part for part in parts if part.lower() not in texts]
    assert max(map(len, parts.values())) <= 22


def test_a_few_words_of_good_open_and_unknown_results():
    good = seen(computed(CUBE, FACES))
    assert in_short(good.sentence) == f"{good.sentence.split()[1]} samples"
    assert in_short(plainly(computed(*icosphere(4)).chosen)) == "2,562 vertices"
    assert in_short(seen(computed(CUBE, FACES[:-1])).sentence) == "Openings were closed"
    assert in_short("Something new (of 3); do this.") == "Something new"


def test_betti_numbers_in_short_leave_out_what_there_is_none_of():
    assert topology.betti_in_short((1, 0, 0)) == ["1 piece"]
    assert topology.betti_in_short((2, 1, 0)) == ["2 pieces", "1 loop"]
    assert topology.betti_in_short((1, 1234, 2)) == ["1 piece", "1,234 loops", "2 cavities"]
