# SPDX-License-Identifier: GPL-3.0-or-later
"""Relations of every operator: objects of any size have a whole result or a sentence, and each is one step of undo."""

import math

import bpy
import numpy as np
import pytest
from installed import addon
from measure import contents, positions, result_of
from scene import ellipsoid, select, torus

FEW = {"sampling": "SURFACE", "samples": 1_000}
# The operators of the add-on that compute from a mesh, with options that keep them quick.
OPERATORS = {
    "medial_axis_sampling_report": FEW,
    "medial_axis_thickness": FEW,
    "medial_axis_skeleton": FEW,
    "medial_axis_balls": {**FEW, "count": 8},
    "medial_axis_reduce": {"vertices": 20},
    "medial_axis_rebuild": {},
    "medial_axis_armature": FEW,
    "tight_cocone_surface": {},
}
REFUSED = ("Expected a scale that Blender can invert", "Expected bones longer than")


@pytest.mark.parametrize("size", [1e-18, 1e-15, 1e-6, 1e6, 1e15, 1e18])
def test_every_operator(size):
    source = ellipsoid(segments=2)
    source.scale = (size, size, size)
    assert bpy.ops.object.medial_axis(form="CLEAN", side="INNER", **FEW) == {"FINISHED"}
    for name, options in OPERATORS.items():
        select(source)
        before = contents()
        try:
            assert getattr(bpy.ops.object, name)(**options) == {"FINISHED"}
        except RuntimeError as error:
            assert name == "medial_axis_armature" and not 1e-5 < size < 1e10
            assert "Traceback" not in str(error) and any(text in str(error) for text in REFUSED)
            assert contents() == before
        bpy.context.view_layer.update()
        for thing in bpy.data.objects:
            assert np.isfinite(np.array(thing.matrix_world)).all(), (name, thing.name)
            if addon("bridge.objects.output_object").source_of(thing) != source:
                continue
            if thing.type == "MESH" and len(thing.data.vertices):
                farthest = max(math.dist(corner, (0, 0, 0)) for corner in thing.bound_box)
                away = thing.matrix_world.translation - source.matrix_world.translation
                assert farthest < 2 * size and away.length < size
    assert result_of(source)["ma_radius_max"] == pytest.approx(0.5 * size, rel=0.05)


# --- undo: the operators of the table, and those that need something else

OTHERS = {
    "object.medial_axis": FEW,
    "object.medial_axis each part": {**FEW, "form": "CLEAN", "each_part": True},
    "object.medial_axis_separate_parts": {},
    "object.medial_axis_to_curve": {},
    "import_mesh.points_xyz": {"filepath": "scan.xyz"},
    "import_mesh.points_off": {"filepath": "solid.off"},
    "object.medial_axis_thickness on the source": {**FEW},
    "object.medial_axis_sequence": {"directory": "", "frames": "1-2"},
}
CORNERS = "0 0 0\n1 0 0\n0 1 0\n"


def everything():
    """Names and counts of all that an operator may have made, or changed on its source."""
    things = bpy.data.objects
    own = [(t.name, len(t.modifiers), len(t.vertex_groups), t.parent is None) for t in things]
    attributes = {mesh.name: sorted(mesh.attributes.keys()) for mesh in bpy.data.meshes}
    return [*contents(), sorted(own), attributes]


def own_of(source):
    """The places, attributes and properties of a source, which only thickness changes."""
    return positions(source.data).tobytes(), source.data.attributes.keys(), dict(source.items())


@pytest.mark.parametrize("name", [*(f"object.{name}" for name in OPERATORS), *OTHERS])
def test_one_step_of_undo(name, tmp_path):
    bpy.context.preferences.edit.use_global_undo = True
    (tmp_path / "scan.xyz").write_text(CORNERS)
    (tmp_path / "solid.off").write_text(f"OFF\n3 1 0\n{CORNERS}3 0 1 2\n")
    options = dict(OTHERS[name] if name in OTHERS else OPERATORS[name.partition(".")[2]])
    for path in {"filepath", "directory"} & set(options):
        options[path] = str(tmp_path / options[path])
    if name.endswith("to_curve"):
        source = torus()
        bpy.ops.object.medial_axis(form="CURVE", **FEW)
    else:
        source = ellipsoid(segments=5 if name.endswith("on the source") else 2)
        if OTHERS.get(name) is not FEW:
            bpy.ops.object.medial_axis(form="CLEAN", side="INNER", **FEW)
    select(source)
    bpy.ops.ed.undo_push(message="Scene is set")
    before, own = everything(), own_of(source)
    group, _, operator = name.partition(" ")[0].partition(".")
    done = getattr(getattr(bpy.ops, group), operator)("EXEC_DEFAULT", True, **options)
    made = everything()
    assert done == {"FINISHED"} and made != before
    assert own_of(source) == own or "thickness" in name
    if name.endswith("on the source"):
        assert made[0] == before[0] and "ma_thickness" in source.data.attributes
    bpy.ops.ed.undo()
    assert everything() == before
    bpy.ops.ed.redo()
    assert everything() == made
