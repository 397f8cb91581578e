# SPDX-License-Identifier: GPL-3.0-or-later
"""A thousand objects and options at random: an answer each, a sound result or one sentence, and never a crash.

A crash ends Blender and so the tests; `run.py -s -k mutants` prints each number before it is tried.
"""

from pathlib import Path

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, contents, positions, radii_are_sound
from mutants import mutant, options

try:
    import resource
except ImportError:  # on Windows
    resource = None

COUNT, BLOCK = 1000, 100
MEMORY = 6 << 30  # bytes of address space that each block may have beyond those that Blender has
OPERATORS = ("medial_axis",) * 6 + ("tight_cocone_surface", "medial_axis_sampling_report")
ATTRIBUTES = {
    "medial_axis": ("ma_radius", "ma_theta", "ma_rho"),
    "tight_cocone_surface": (),
    "medial_axis_sampling_report": ("ma_epsilon", "ma_feature_size", "ma_spacing"),
}


STARTS = [0, *(pytest.param(start, marks=pytest.mark.slow) for start in range(BLOCK, COUNT, BLOCK))]


@pytest.fixture
def little_memory():
    """Limits the memory, where the system can, so that an excessive computation fails and not the machine."""
    if resource is None:
        yield
        return
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    limits = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + MEMORY, limits[1]))
    yield
    resource.setrlimit(resource.RLIMIT_AS, limits)


@pytest.mark.parametrize("start", STARTS)
def test_mutants(start, little_memory):
    wrong, finished = [], 0
    for seed in range(start, start + BLOCK):
        print(f"mutant {seed}", flush=True)
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        try:
            finished += attempt(seed) == {"FINISHED"}
        except Exception as failure:
            wrong.append(f"mutant {seed}: {failure!r}")
    assert not wrong, "\n".join(wrong)
    assert BLOCK / 10 < finished < BLOCK, "neither all refused nor all fine"


def attempt(seed):
    """Run an operator on a mutant; its answer, or the sentence that it raised."""
    thing, random = mutant(seed)
    name = OPERATORS[random.integers(len(OPERATORS))]
    operator = getattr(bpy.ops.object, name)
    known = operator.get_rna_type().properties.keys()
    chosen = {key: value for key, value in options(random).items() if key in known}
    if "target" in known:
        chosen["target"] = ("COPY", "SOURCE")[random.integers(2)]
    before, data, mode = contents(), state(thing), thing.mode
    single = len(bpy.context.selected_objects) < 2  # else one may be refused, and others fine
    try:
        answer = operator(**chosen)
    except RuntimeError as error:
        answer = str(error)
        assert answer.startswith("Error: '") or ".poll() Select " in answer, answer
        assert "Traceback" not in answer and "enough memory" not in answer
    assert thing.mode == mode
    assert np.array_equal(state(thing), data, equal_nan=True), "the source was changed"
    if answer == {"FINISHED"}:
        if "SOURCE" in chosen.values():
            assert np.isfinite(attribute(thing.data, "ma_epsilon")).all()
        else:
            check_made(name)
        again = operator(**chosen) if operator.poll() else answer
        assert again == answer
    elif single:
        assert contents() == before, f"after {answer} something was left"
    assert addon("ui.base.current_job").job() is None
    return answer


def state(thing):
    """The points of a mesh."""
    return positions(thing.data) if thing.type == "MESH" else np.zeros((0, 3))


def check_made(name):
    """The result is a valid mesh of finite numbers."""
    made = [other for other in bpy.data.objects if "ma_version" in other]
    assert made, "nothing was made"
    for other in made:
        mesh = other.data
        assert mesh.validate() is False, "the mesh was not valid"
        assert np.isfinite(positions(mesh)).all() and len(mesh.vertices) > 0
        assert np.isfinite(np.array(other.matrix_world)).all()
        for attribute_name in ATTRIBUTES[name]:
            assert np.isfinite(attribute(mesh, attribute_name)).all(), attribute_name
        if name == "medial_axis":
            # Sheets without thickness have a radius of 0 in a wrap.
            wrapped = other["ma_sides"] == "WRAP" and (attribute(mesh, "ma_radius") >= 0).all()
            assert wrapped or radii_are_sound(mesh)
