# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of any size: every operator makes a whole result or says in a sentence why it cannot."""

import math

import bpy
import numpy as np
import pytest
from scene import addon, contents, ellipsoid, result_of, select

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
            if addon("bridge.objects.output_object").source_of(thing) == source:
                assert_same_place(thing, source, size)
    assert result_of(source)["ma_radius_max"] == pytest.approx(0.5 * size, rel=0.05)


def assert_same_place(thing, source, size):
    """The bounds of what was made lie in those of the source."""
    if thing.type == "MESH" and len(thing.data.vertices):
        farthest = max(math.dist(corner, (0, 0, 0)) for corner in thing.bound_box)
        assert farthest < 2 * size
        assert math.dist(thing.matrix_world.translation, source.matrix_world.translation) < size
