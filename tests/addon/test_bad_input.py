# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input through the operator: one sentence each; never a crash, a NaN or half an object."""

import bpy
import numpy as np
import pytest
from scene import (
    addon,
    attribute,
    compute,
    compute_or_not,
    ellipsoid,
    link,
    medial_objects,
    positions,
    radii_are_sound,
    refuse,
    reports,
    result_of,
    select,
    triangles_of,
)

SQUARE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
CUBE = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]


def sound(result):
    """The result is a valid mesh of finite numbers."""
    mesh = result.data
    assert len(mesh.polygons) > 0
    assert mesh.validate() is False
    assert np.isfinite(positions(mesh)).all()
    for name in ("ma_radius", "ma_theta", "ma_rho"):
        assert np.isfinite(attribute(mesh, name)).all()
    assert radii_are_sound(mesh)


def test_nothing_selected():
    refuse("Select a mesh, point cloud, curve, .*; nothing is selected")


@pytest.mark.parametrize("add", ["camera_add", "empty_add", "light_add"])
def test_wrong_type(add):
    getattr(bpy.ops.object, add)()
    refuse("Select a mesh, point cloud, curve, .*; .* is of type")


@pytest.mark.parametrize("count", [0, 1, 2, 3])
def test_too_few_points(count):
    link("Few", CUBE[:count])
    refuse(r"'Few': .*(point|row)")


@pytest.mark.parametrize(
    ("points", "word"),
    [
        ([(1, 2, 3)] * 8, "distinct|same|identical"),
        ([(t, 2 * t, -t) for t in range(9)], "line"),
        ([(x, y, 0) for x in range(4) for y in range(4)], "plane"),
    ],
    ids=["identical", "collinear", "coplanar"],
)
def test_points_without_volume(points, word):
    link("Flat", points)
    refuse(f"'Flat': .*({word})")


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_not_finite_says_which_row(value):
    points = np.random.default_rng(3).normal(size=(50, 3))
    points[17, 1] = value
    link("Broken", points)
    assert "17" in refuse("'Broken': ")


def test_transform_that_is_not_finite():
    source = ellipsoid()
    source.parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(source.parent)
    source.matrix_parent_inverse[0][0] = np.nan
    refuse("'Ellipsoid': Expected a finite transform, found NaN")


def test_duplicates_are_merged_and_counted():
    points = np.random.default_rng(4).normal(size=(60, 3)).astype(np.float32)
    source = link("Twice", np.concatenate([points, points[:25]]))
    compute(side="BOTH")
    assert result_of(source)["ma_duplicates"] == 25 and result_of(source)["ma_points"] == 85
    sound(result_of(source))


def test_split_vertices_still_close_the_surface():
    source = ellipsoid()
    source.modifiers.new("Split", "EDGE_SPLIT").split_angle = 0
    result = compute()
    assert result["ma_side"] == "INNER" and result["ma_duplicates"] == 960 - 162


def test_unreferenced_vertices():
    box = grid_box()
    count = len(box.data.vertices)
    box.data.vertices.add(2)
    box.data.vertices[count].co = (0.2, 0.1, 0.3)
    box.data.vertices[count + 1].co = (3, 3, 3)
    compute()
    assert result_of(box)["ma_points"] == count + 2
    sound(result_of(box))


@pytest.mark.parametrize(
    "add", ["primitive_uv_sphere_add", "primitive_ico_sphere_add", "primitive_cube_add"]
)
def test_cospherical_samples(add):
    """Their axis is a point or nearly so: either sound facets, or one warning and no object."""
    getattr(bpy.ops.mesh, add)()
    source = bpy.context.object
    answer = compute_or_not()
    if answer == {"FINISHED"}:
        sound(result_of(source))
    else:
        assert answer == {"CANCELLED"} and medial_objects() == []


@pytest.mark.parametrize("size", [1e-9, 1e-6, 1.0, 1e6, 1e9])
def test_size_does_not_matter(size):
    points = np.random.default_rng(6).normal(size=(80, 3)).astype(np.float32)
    source = link("Scaled", points * np.float32(size))
    compute(side="BOTH")
    sound(result_of(source))
    small = attribute(result_of(source).data, "ma_radius").min() / size
    assert 1e-3 < small < 10


def test_cloud_far_from_the_origin():
    points = np.random.default_rng(8).normal(size=(80, 3)).astype(np.float32)
    source = link("Far", points + np.float32(1e6))
    compute(side="BOTH")
    sound(result_of(source))
    moved = link("Moved", points)
    moved.location = (1e6, 1e6, 1e6)
    compute(side="BOTH")
    sound(result_of(moved))
    assert np.abs(positions(result_of(moved).data)).max() < 1e5  # the offset stays in the matrix


def grid_box(n=5):
    """A closed box whose faces are grids: cocircular and cospherical points everywhere."""
    bpy.ops.mesh.primitive_cube_add()
    box = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=n)
    bpy.ops.object.mode_set(mode="OBJECT")
    return box


def test_grid():
    bpy.ops.mesh.primitive_grid_add()
    refuse("'Grid': .*plane")


@pytest.mark.parametrize("turned", [False, True], ids=["straight", "turned in float32"])
def test_box_of_grids(turned):
    box = grid_box()
    if turned:
        box.rotation_euler = (0.3, 0.7, -1.1)
        bpy.ops.object.transform_apply()
    compute()
    assert result_of(box)["ma_side"] == "INNER"
    sound(result_of(box))


def test_inward_faces_are_read_outward(capfd):
    """The axis is that of the faces turned round, which a sentence says."""
    source = ellipsoid()
    compute()
    expected = positions(result_of(source).data)
    source.data.flip_normals()
    compute()
    warnings = [text for kind, text in reports(capfd) if kind == "Warning"]
    assert any("faces looked inward" in text for text in warnings), warnings
    assert np.array_equal(positions(result_of(source).data), expected)


def test_empty_result_leaves_an_older_one_untouched(capfd):
    source = ellipsoid()
    compute()
    count = len(result_of(source).data.polygons)
    select(source)
    assert compute_or_not(criteria="RATIO", rho=1e9) == {"CANCELLED"}
    assert len(result_of(source).data.polygons) == count
    assert result_of(source)["ma_criteria"] == "ANGLE_OR_RATIO"
    assert any("no facet passes" in text for kind, text in reports(capfd) if kind == "Warning")


@pytest.mark.parametrize("chosen", ["result", "source"])
def test_a_source_hidden_by_h_is_read_as_it_was_seen(chosen):
    """H hides and deselects; the source stays active, and buttons act on what is still shown of it."""
    source = ellipsoid()
    source.modifiers.new("Subdivision", "SUBSURF").levels = 1
    result = compute()
    points = result["ma_points"]
    source.hide_set(True)
    select(result) if chosen == "result" else select()
    bpy.context.view_layer.objects.active = {"result": result, "source": source}[chosen]
    for operator in (
        "medial_axis_thickness",
        "medial_axis_armature",
        "medial_axis_sampling_report",
    ):
        assert getattr(bpy.ops.object, operator).poll(), operator
    compute(select_result=False)
    assert result["ma_points"] == points and "ma_source_state" in result
    assert source.hide_get() and len(medial_objects()) == 1
    result.hide_set(True)
    select()
    bpy.context.view_layer.objects.active = source
    refuse("nothing is selected")


@pytest.mark.parametrize(
    "kind", ["closed", "open", "split", "two shells", "flipped face", "edge of three"]
)
def test_open_edges_are_counted_with_and_without_an_analysis(kind):
    source = ellipsoid(segments=2)
    points, triangles = positions(source.data), triangles_of(source.data)
    if kind == "open":
        triangles = triangles[5:]
    elif kind == "split":
        points, triangles = (
            points[triangles.ravel()],
            np.arange(triangles.size, dtype=np.int32).reshape(-1, 3),
        )
    elif kind == "two shells":
        triangles = np.concatenate([triangles, triangles + len(points)])
        points = np.concatenate([points, points + 5.0])
    elif kind == "flipped face":
        triangles[3] = triangles[3, ::-1]
    elif kind == "edge of three":
        extra = np.array([[triangles[0, 0], triangles[0, 1], len(points)]], np.int32)
        triangles, points = (
            np.concatenate([triangles, extra]),
            np.concatenate([points, [[9.0, 9.0, 9.0]]]),
        )
    native = addon("core.machine.native").load()
    analysis = native.MedialAnalysis(points, triangles)
    gaps = native.open_edges(points, triangles)
    assert gaps == analysis.boundary_edges
    assert (gaps == 0) == analysis.closed == (kind in ("closed", "split", "two shells"))
    if kind == "flipped face":
        assert gaps == 3
