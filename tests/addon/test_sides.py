# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the source of inside and outside: which one is used and why, its reports, and its errors."""

import bpy
import numpy as np
import pytest
from installed import addon
from measure import analyses, attribute, direct, generators, open_edges, positions, read, reports
from scene import compute, ellipsoid, opened, scan, select
from support.clouds import on_ellipsoid


def oriented(name="Oriented", flip=1.0):
    points, normals = on_ellipsoid()
    return scan(name, points, flip * normals)


def with_normals(source):
    """An ellipsoid whose points have normals."""
    normals = positions(source.data) / np.square([1.0, 0.7, 0.5])
    addon("bridge.mesh.attributes").add_normals(source.data.attributes, normals)
    return source


def open_oriented():
    return with_normals(opened())


WHY = {
    "closed mesh": (ellipsoid, "SURFACE", "Surface: the faces are closed"),
    "open mesh": (opened, "SURFACE", "Surface: the winding number of the faces, for the mesh is open at {} edges"),
    "points": (scan, "TIGHT_COCONE", "Tight Cocone: the points have no faces and no normals"),
    "oriented points": (oriented, "NORMALS", "Normals: the points have no faces"),
    "open mesh with normals": (open_oriented, "NORMALS", "Normals: the mesh is open at {} edges"),
}  # fmt: skip


@pytest.mark.parametrize(("make", "sides", "sentence"), WHY.values(), ids=WHY)
def test_automatic_says_which_and_why(make, sides, sentence):
    source = make()
    sentence = sentence.format(open_edges(source.data))
    result = compute()
    assert (result["ma_side"], result["ma_sides"]) == ("INNER", sides)
    assert result["ma_inside"] == f"Inside from {sentence}"
    assert set(attribute(result.data, "ma_side")) == {1}
    module, shape = addon("core.machine.native").load(), read(source)
    triangles = shape.triangles if sides == "SURFACE" else None
    normals = addon("bridge.mesh.attributes").read_normals(source.data.attributes)
    told = {"sides": getattr(module.SidesFrom, sides)}
    if sides == "NORMALS":
        told["normals"] = normals
    analysis = module.MedialAnalysis(positions(source.data), triangles, **told)
    expected = analysis.extract(side=module.Side.INNER)
    np.testing.assert_array_equal(generators(result.data), expected.generators)


def test_unknown_and_wrong_attributes_are_no_normals():
    attributes = scan().data.attributes
    attributes.new("normal", "FLOAT", "POINT")
    attributes.new("ma_normal", "FLOAT_COLOR", "POINT")
    attributes.new("Normal", "FLOAT_VECTOR", "POINT")
    assert compute()["ma_sides"] == "TIGHT_COCONE"


@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (2, 0.5, 1), (-1, -2, -3)], ids=str)
def test_normals_turn_with_the_object(scale, capfd):
    """Inside stays inside if the object is mirrored or stretched, too."""
    source = oriented()
    source.scale = scale
    source.rotation_euler = (0.4, -0.8, 1.3)
    select(source)
    shape = read(source)
    rest = addon("bridge.objects.read_object").split_transform(np.array(source.matrix_world))[1]
    unit = np.linalg.solve(rest, shape.points.T).T
    unmoved = unit / np.square([1.0, 0.7, 0.5])
    outward = np.linalg.solve(rest.T, unmoved.T).T
    lengths = [np.linalg.norm(vectors, axis=1) for vectors in (outward, shape.normals)]
    cosines = (outward * shape.normals).sum(axis=1) / (lengths[0] * lengths[1])
    assert cosines.min() > 0.9999
    result = compute()
    assert result["ma_sides"] == "NORMALS" and set(attribute(result.data, "ma_side")) == {1}
    assert not [text for kind, text in reports(capfd) if kind == "Warning"]


def test_sliders_keep_what_told_inside_from_outside():
    source, panel = scan(), bpy.context.scene.medial_axis
    result, before = compute(mesh="VORONOI"), analyses()
    count, inside = len(result.data.polygons), result["ma_inside"]
    panel.sides, panel.mesh = "SURFACE", "VORONOI"
    panel.criteria, panel.theta = "ANGLE", 1.0
    assert 0 < len(result.data.polygons) < count and panel.note == ""
    assert (result["ma_sides"], result["ma_side"]) == ("TIGHT_COCONE", "INNER")
    assert result["ma_inside"] == inside and analyses() == before
    module = addon("core.machine.native").load()
    wanted = {"side": module.Side.INNER, "theta": 1.0, "criteria": module.Criteria.ANGLE}
    expected = direct(positions(source.data), **wanted)
    # the faces of a sheet all turn the same way, so some have their samples exchanged
    np.testing.assert_array_equal(np.sort(generators(result.data), axis=1), expected.generators)


def test_edit_mode_keeps_the_normals():
    oriented()
    bpy.ops.object.mode_set(mode="EDIT")
    assert compute()["ma_sides"] == "NORMALS"
