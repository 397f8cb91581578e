# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the source of inside and outside: which one is used and why, its reports, and its errors."""

import collections
import re

import bpy
import numpy as np
import pytest
from scene import (
    addon,
    analyses,
    attribute,
    compute,
    compute_or_not,
    direct,
    ellipsoid,
    link,
    on_ellipsoid,
    opened,
    positions,
    refuse,
    reports,
    result_of,
    scan,
    select,
    triangles_of,
)


def warnings(capfd):
    return [text for kind, text in reports(capfd) if kind == "Warning"]


def facets(result):
    """The generators of all facets."""
    mesh = result.data
    if "ma_generators" in mesh.attributes:
        return attribute(mesh, "ma_generators")
    return np.column_stack([attribute(mesh, f"ma_generator_{end}") for end in "ab"])


def boundary(mesh):
    """How many edges have one face."""
    faces = collections.Counter(key for polygon in mesh.polygons for key in polygon.edge_keys)
    return sum(count == 1 for count in faces.values())


def oriented(name="Oriented", flip=1.0):
    points, normals = on_ellipsoid()
    return scan(name, points, flip * normals)


def open_oriented():
    """An open mesh whose points have normals."""
    source = opened()
    normals = positions(source.data) / np.square([1.0, 0.7, 0.5])
    addon("bridge.attributes").add_normals(source.data.attributes, normals)
    return source


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
        triangles_of(source.data) if sides == "SURFACE" else None,
        normals=addon("bridge.attributes").read_normals(source.data.attributes)
        if sides == "NORMALS"
        else None,
        sides=getattr(module.SidesFrom, sides),
    ).extract(side=module.Side.INNER)
    np.testing.assert_array_equal(facets(result), expected.generators)


@pytest.mark.parametrize("sides", ["SURFACE", "NORMALS", "TIGHT_COCONE", "POLES"])
def test_chosen_source_is_used_although_all_are_there(sides):
    source = ellipsoid()
    normals = positions(source.data) / np.square([1.0, 0.7, 0.5])
    addon("bridge.attributes").add_normals(source.data.attributes, normals)
    result = compute(sides=sides)
    assert result["ma_sides"] == sides and result["ma_inside"].endswith(": as chosen")
    samples = addon("core.machine.cache").CACHE.get(result["ma_analysis"])
    assert samples.analysis.sides_from.name == sides


def test_all_sources_agree_on_a_clean_shape():
    axes = []
    for sides in ("SURFACE", "NORMALS", "TIGHT_COCONE", "POLES"):
        source = ellipsoid(sides, segments=4)
        normals = positions(source.data) / np.square([1.0, 0.7, 0.5])
        addon("bridge.attributes").add_normals(source.data.attributes, normals)
        compute(sides=sides)
        axes.append(set(map(tuple, facets(result_of(source)))))
    common, either = set.intersection(*axes), set.union(*axes)
    assert len(common) > 0.97 * len(either) > 100


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


def test_zero_normals_are_no_normals():
    points, normals = on_ellipsoid()
    source = scan(points=points, normals=0 * normals)
    compute()
    assert result_of(source)["ma_inside"].endswith("the points have no faces and no normals")
    select(source)
    refuse("'Scan': Expected an attribute 'normal' .*not all zero", sides="NORMALS")


def test_some_normals_are_enough():
    points, normals = on_ellipsoid()
    normals[::3] = 0
    source = scan(points=points, normals=normals)
    compute()
    assert result_of(source)["ma_sides"] == "NORMALS" and result_of(source)["ma_warnings"] == ""


def test_normals_of_any_length():
    points, normals = on_ellipsoid()
    lengths = np.random.default_rng(1).uniform(0.01, 100, (len(points), 1))
    first, second = scan("Unit", points, normals), scan("Uneven", points, normals * lengths)
    select(first, second)
    compute()
    np.testing.assert_array_equal(facets(result_of(first)), facets(result_of(second)))


def test_normals_that_are_not_finite():
    points, normals = on_ellipsoid()
    normals[17, 1] = np.nan
    scan(points=points, normals=normals)
    assert "row 17" in refuse("'Scan': .*finite")


def test_normals_that_point_inward_are_noticed(capfd):
    source = oriented(flip=-1.0)
    assert compute_or_not() == {"CANCELLED"}  # this shape has no outer axis
    (text,) = warnings(capfd)
    assert "'Oriented': the normals point inward" in text
    compute(side="BOTH")
    assert "the normals point inward" in result_of(source)["ma_warnings"]


@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (2, 0.5, 1), (-1, -2, -3)], ids=str)
def test_normals_turn_with_the_object(scale, capfd):
    """Inside stays inside if the object is mirrored or stretched, too."""
    source = oriented()
    source.scale = scale
    source.rotation_euler = (0.4, -0.8, 1.3)
    select(source)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    shape = addon("bridge.read_object").read_object(source, depsgraph)
    rest = addon("bridge.read_object").split_transform(np.array(source.matrix_world))[1]
    unit = np.linalg.solve(rest, shape.points.T).T
    unmoved = unit / np.square([1.0, 0.7, 0.5])
    outward = np.linalg.solve(rest.T, unmoved.T).T
    lengths = [np.linalg.norm(vectors, axis=1) for vectors in (outward, shape.normals)]
    cosines = (outward * shape.normals).sum(axis=1) / (lengths[0] * lengths[1])
    assert cosines.min() > 0.9999
    compute()
    assert result_of(source)["ma_sides"] == "NORMALS" and warnings(capfd) == []
    assert set(attribute(result_of(source).data, "ma_side")) == {1}


def test_surface_without_faces():
    scan()
    refuse(
        "'Scan': Expected faces for Inside Decided By Surface, found points only", sides="SURFACE"
    )


@pytest.mark.parametrize("make", [scan, ellipsoid], ids=["points", "mesh"])
def test_normals_without_normals(make):
    make()
    refuse("Expected an attribute 'normal' of the points", sides="NORMALS")


@pytest.mark.parametrize("side", ["AUTOMATIC", "INNER", "OUTER"])
def test_points_that_enclose_nothing(side):
    link("Dust", np.random.default_rng(2).normal(size=(300, 3)))
    sentence = refuse("'Dust': .* that enclose nothing", side=side, prepare="OFF")
    assert "more densely" in sentence and "side Both" in sentence


def test_points_that_enclose_nothing_have_a_whole_axis(capfd):
    source = link("Dust", np.random.default_rng(2).normal(size=(300, 3)))
    compute(side="BOTH", prepare="OFF")
    assert 2 in set(attribute(result_of(source).data, "ma_side"))
    assert any("enclose nothing" in text for text in warnings(capfd))


def test_open_surface_says_what_was_assumed(capfd):
    source = opened()
    compute(sides="SURFACE")
    found = warnings(capfd)
    sparse, assumed = found  # the vertices are few, too
    assert "too sparse" in sparse and result_of(source)["ma_warnings"].count("\n") == 1
    assert f"'Open': the surface is open at {boundary(source.data)} edges" in assumed
    assert "winding number" in assumed


def test_noise_is_noticed(capfd):
    points, _ = on_ellipsoid(5000)
    points += np.random.default_rng(3).normal(scale=0.01, size=points.shape)
    source = scan(points=points)
    compute(prepare="OFF")
    text = "\n".join(warnings(capfd))
    assert "noise of about 0.33 spacings was found and left as it is" in text
    assert "points are not on the surface that Tight Cocone found" in text
    assert "touches itself at" in text and "do not look like samples of a smooth surface" in text
    assert "too sparse" not in text  # more points of this noise would not help
    compute(form="CLEAN")
    (moved,) = warnings(capfd)
    assert "the points were moved by 0.23 spacings in the median" in moved
    assert result_of(source)["ma_topology"].startswith("1 piece, no loop, no cavity")


def test_closed_cavity_is_noticed():
    source = hollow_scan()
    compute(sides="TIGHT_COCONE")
    assert "closed cavities, which Tight Cocone fills" in result_of(source)["ma_warnings"]


def test_automatic_keeps_a_closed_cavity():
    """Points alone: their poles contradict Tight Cocone, and are believed."""
    hollow_scan()
    result = compute()
    assert result["ma_sides"] == "POLES" and "cavities" not in result["ma_warnings"]
    begun = "Inside from Poles: the points have no faces and no normals, and the poles of "
    assert re.fullmatch(
        re.escape(begun) + r"\d\d% of the points contradict Tight Cocone", result["ma_inside"]
    )
    middle = np.linalg.norm(positions(result.data) / [1.0, 0.7, 0.5], axis=1)
    assert middle.min() > 0.6 and middle.max() < 0.8  # between the walls, none in the cavity


def hollow_scan():
    points, _ = on_ellipsoid(6000)
    return scan(points=np.concatenate([points, 0.4 * points[::4]]))


def test_closed_openings_are_noticed(capfd):
    points, _ = on_ellipsoid(6000)
    source = scan(points=points[points[:, 2] > -0.2])
    compute()
    (text,) = [text for text in warnings(capfd) if "openings" in text]
    assert "more than 10 times as wide as most" in text
    assert "Tight Cocone closed openings" in result_of(source)["ma_warnings"]


def test_facets_without_area_are_counted():
    """On a torus of rings most of the axis is a line."""
    bpy.ops.mesh.primitive_torus_add(major_segments=96, minor_segments=24)
    compute()
    result = bpy.context.object
    axis = addon("bridge.read_axis").read_axis(result)
    assert result["ma_zero_area"] == axis.zero_area > 0


def test_faces_do_not_matter_to_tight_cocone():
    source, bare = ellipsoid(), None
    compute(sides="TIGHT_COCONE")
    before = analyses()
    bare = scan("Bare", positions(source.data))
    compute(sides="TIGHT_COCONE")
    assert analyses() == before, "the same points are the same analysis"
    np.testing.assert_array_equal(facets(result_of(bare)), facets(result_of(source)))


def test_another_source_is_another_analysis():
    source = ellipsoid()
    compute()
    before = analyses()
    compute(source, sides="TIGHT_COCONE")
    assert analyses() == before + 1 and result_of(source)["ma_sides"] == "TIGHT_COCONE"


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
    np.testing.assert_array_equal(np.sort(facets(result), axis=1), expected.generators)


def test_edit_mode_keeps_the_normals():
    source = oriented()
    bpy.ops.object.mode_set(mode="EDIT")
    compute()
    assert result_of(source)["ma_sides"] == "NORMALS"
