# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the source of inside and outside: which one is used and why, its reports, and its errors."""

import collections

import bpy
import numpy as np
import pytest
from installed import addon
from measure import analyses, attribute, direct, generators, positions, read, reports, result_of
from scene import compute, ellipsoid, opened, scan, select
from support.clouds import on_ellipsoid


def warnings(capfd):
    return [text for kind, text in reports(capfd) if kind == "Warning"]


def boundary(mesh):
    """How many edges have one face."""
    faces = collections.Counter(key for polygon in mesh.polygons for key in polygon.edge_keys)
    return sum(count == 1 for count in faces.values())


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


@pytest.mark.parametrize(
    ("make", "sides", "sentence"),
    [
        (ellipsoid, "SURFACE", "Inside from Surface: the faces are closed"),
        (
            opened,
            "SURFACE",
            "Inside from Surface: the winding number of the faces, for the mesh is open at {} edges",
        ),
        (
            scan,
            "TIGHT_COCONE",
            "Inside from Tight Cocone: the points have no faces and no normals",
        ),
        (oriented, "NORMALS", "Inside from Normals: the points have no faces"),
        (open_oriented, "NORMALS", "Inside from Normals: the mesh is open at {} edges"),
    ],
    ids=["closed mesh", "open mesh", "points", "oriented points", "open mesh with normals"],
)
def test_automatic_says_which_and_why(make, sides, sentence):
    source = make()
    sentence = sentence.format(boundary(source.data))
    result = compute()
    assert (result["ma_side"], result["ma_sides"]) == ("INNER", sides)
    assert result["ma_inside"] == sentence
    assert set(attribute(result.data, "ma_side")) == {1}
    module = addon("core.machine.native").load()
    expected = module.MedialAnalysis(
        positions(source.data),
        read(source).triangles if sides == "SURFACE" else None,
        normals=addon("bridge.mesh.attributes").read_normals(source.data.attributes)
        if sides == "NORMALS"
        else None,
        sides=getattr(module.SidesFrom, sides),
    ).extract(side=module.Side.INNER)
    np.testing.assert_array_equal(generators(result.data), expected.generators)


@pytest.mark.parametrize("sides", ["SURFACE", "NORMALS", "TIGHT_COCONE", "POLES"])
def test_chosen_source_is_used_although_all_are_there(sides):
    result = compute(with_normals(ellipsoid()), sides=sides)
    assert result["ma_sides"] == sides and result["ma_inside"].endswith(": as chosen")
    samples = addon("core.machine.cache").CACHE.get(result["ma_analysis"])
    assert samples.analysis.sides_from.name == sides


def test_unknown_and_wrong_attributes_are_no_normals():
    source = scan()
    for name, kind, domain in (
        ("normal", "FLOAT", "POINT"),
        ("ma_normal", "FLOAT_COLOR", "POINT"),
        ("Normal", "FLOAT_VECTOR", "POINT"),
    ):
        source.data.attributes.new(name, kind, domain)
    compute()
    assert result_of(source)["ma_sides"] == "TIGHT_COCONE"


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
    compute()
    assert result_of(source)["ma_sides"] == "NORMALS" and warnings(capfd) == []
    assert set(attribute(result_of(source).data, "ma_side")) == {1}


def test_sliders_keep_what_told_inside_from_outside():
    source = scan()
    compute(mesh="VORONOI")
    result, before = result_of(source), analyses()
    count, inside = len(result.data.polygons), result["ma_inside"]
    panel = bpy.context.scene.medial_axis
    panel.sides, panel.mesh = "SURFACE", "VORONOI"
    panel.criteria, panel.theta = "ANGLE", 1.0
    assert 0 < len(result.data.polygons) < count and panel.note == ""
    assert (result["ma_sides"], result["ma_side"]) == ("TIGHT_COCONE", "INNER")
    assert result["ma_inside"] == inside and analyses() == before
    module = addon("core.machine.native").load()
    expected = direct(
        positions(source.data),
        side=module.Side.INNER,
        theta=1.0,
        criteria=module.Criteria.ANGLE,
    )
    # the faces of a sheet all turn the same way, so some have their samples exchanged
    np.testing.assert_array_equal(np.sort(generators(result.data), axis=1), expected.generators)


def test_edit_mode_keeps_the_normals():
    source = oriented()
    bpy.ops.object.mode_set(mode="EDIT")
    compute()
    assert result_of(source)["ma_sides"] == "NORMALS"
