# SPDX-License-Identifier: GPL-3.0-or-later
"""Convert to Curve, and the directions of facets and edges that instances follow."""

import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Matrix
from measure import attribute, evaluated, loose_edges, positions
from scene import cells, compute, ellipsoid, exclude, link, press, refuse, select, torus, with_radii

CURVE = {"form": "CURVE", "sampling": "SURFACE", "samples": 1_500}


def test_a_curve_has_the_places_and_radii_of_the_wires():
    source = torus()
    source.location = (1.0, 2.0, 3.0)
    axis = compute(**CURVE)
    curve = press("medial_axis_to_curve")
    assert curve.type == "CURVE" and curve.select_get() and not axis.select_get()
    (spline,), (places,) = curve.data.splines, splines_of(curve)
    assert spline.use_cyclic_u and len(places) == len(axis.data.vertices)
    order = np.lexsort(places.T), np.lexsort(positions(axis.data).T)
    np.testing.assert_array_equal(places[order[0]], positions(axis.data)[order[1]])
    radius = np.array([point.radius for point in spline.points])
    np.testing.assert_allclose(radius[order[0]], attribute(axis.data, "ma_radius")[order[1]])
    bpy.context.view_layer.update()
    assert curve.matrix_world == axis.matrix_world and curve.parent == source


def test_there_is_no_curve_of_sheets_alone():
    compute(ellipsoid(), sampling="SURFACE", samples=1_500)
    assert not bpy.ops.object.medial_axis_to_curve.poll()


def splines_of(curve):
    return [np.array([point.co[:3] for point in one.points]) for one in curve.data.splines]


def assert_as_long_as_wires(curve, mesh):
    """The lines of a curve are as long as the edges of a mesh that have no face."""
    ends = positions(mesh)[loose_edges(mesh)]
    wires = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()
    lines = [np.linalg.norm(np.diff(one, axis=0), axis=1).sum() for one in splines_of(curve)]
    assert sum(lines) == pytest.approx(wires, rel=1e-5)


def test_branches_meet_at_a_fork():
    cells(*((x, 0, 0) for x in range(9)), *((4, y, 0) for y in range(1, 5)))
    axis = compute(form="CURVE", sampling="SURFACE", samples=3_000, limb=10.0)
    curve = press("medial_axis_to_curve")
    splines = splines_of(curve)
    assert len(splines) == 3 and not any(one.use_cyclic_u for one in curve.data.splines)
    ends = [{tuple(one[0]), tuple(one[-1])} for one in splines]
    (fork,) = set.intersection(*ends)
    np.testing.assert_allclose(fork, (4.5, 0.5, 0.5), atol=0.4)
    assert len(set.union(*ends)) == 4
    assert_as_long_as_wires(curve, axis.data)


def test_vertices_of_sheets_are_no_points_of_the_curve():
    block = [(x, y, z) for x in range(3) for y in range(3) for z in range(3)]
    bar, other = [(x, 1, 1) for x in range(3, 8)], [(x + 8, y, z) for x, y, z in block]
    cells(*block, *bar, *other)
    axis = compute(form="CLEAN", sampling="SURFACE", samples=3_000, simplify=2.0)
    wires = loose_edges(axis.data)
    assert len(axis.data.polygons) > 100 and len(wires) > 20, "sheets and wires"
    curve = press("medial_axis_to_curve")
    assert all(len(one) > 1 for one in splines_of(curve))
    assert_as_long_as_wires(curve, axis.data)


HIDE = {
    "eye": lambda thing: thing.hide_set(True),
    "viewport": lambda thing: setattr(thing, "hide_viewport", True),
    "collection": exclude,
}


@pytest.mark.parametrize("hide", HIDE.values(), ids=HIDE)
@pytest.mark.parametrize("which", ["source", "axis"])
def test_what_is_hidden_is_converted_too(which, hide):
    source = torus()
    source.location = (1.0, 2.0, 3.0)
    axis = compute(**CURVE)
    hidden, other = (source, axis) if which == "source" else (axis, source)
    place, count = axis.matrix_world.copy(), len(axis.data.vertices)
    select(other)
    hide(hidden)
    bpy.context.view_layer.update()
    curve = press("medial_axis_to_curve")
    assert [curve] == [thing for thing in bpy.data.objects if thing.type == "CURVE"]
    assert len(splines_of(curve)[0]) == count
    assert curve.visible_get() and curve.select_get()
    bpy.context.view_layer.update()
    assert np.allclose(curve.matrix_world, place, atol=1e-6)
    assert axis.users_collection and not hidden.visible_get()


def test_the_normals_of_sheets_do_not_say_what_is_inside():
    result = compute(ellipsoid(), form="CLEAN", sampling="SURFACE", samples=1_500)
    read_normals = addon("bridge.mesh.attributes").read_normals
    assert read_normals(result.data.attributes) is None


def test_huge_axes_have_normals():
    source = ellipsoid(segments=3)
    source.data.transform(Matrix.Scale(1e37, 4))
    mesh = compute(form="CLEAN").data
    length = np.linalg.norm(attribute(mesh, "ma_normal"), axis=1)
    assert np.isclose(length, 1.0, atol=1e-5).mean() > 0.9
    assert mesh.validate() is False


def arrows_along(thing, name):
    """(n, 3) where the Z of instances points that Geometry Nodes turn along an attribute, and (n, 3) where they are."""
    tree = addon("bridge.nodes.tree").Tree("Arrows")
    along = tree.node("GeometryNodeInputNamedAttribute", name, data_type="FLOAT_VECTOR")
    turn = tree.node("FunctionNodeAlignEulerToVector", named={"Vector": along}, axis="Z")
    points = tree.node("GeometryNodeMeshToPoints", named={"Mesh": tree.geometry})
    cone = tree.node("GeometryNodeMeshCone")
    wanted = {"Points": points, "Instance": cone, "Rotation": turn}
    arrows = tree.node("GeometryNodeInstanceOnPoints", named=wanted)
    thing.modifiers.clear()
    thing.modifiers.new("Arrows", "NODES").node_group = tree.output(arrows)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    turned = [one.matrix_world.copy() for one in depsgraph.object_instances if one.is_instance]
    return np.array([m.col[2][:3] for m in turned]), np.array([m.translation for m in turned])


def test_instances_follow_the_curve():
    torus()
    axis = compute(**CURVE)
    assert axis.data.attributes["ma_tangent"].domain == "POINT"
    arrows, places = arrows_along(axis, "ma_tangent")
    assert len(arrows) == len(axis.data.vertices) > 50
    circle = np.cross((0.0, 0.0, 1.0), places / np.linalg.norm(places, axis=1)[:, None])
    along = np.sum(arrows * circle, axis=1)
    assert np.abs(along).min() > 0.95 and (np.all(along > 0) or np.all(along < 0))


def test_the_group_of_balls_shows_thousands():
    points = np.random.default_rng(2).random((60_000, 3))
    thing = with_radii(link("Many", points), np.full(60_000, 0.01))
    groups = addon("bridge.nodes.groups")
    modifier = groups.add_few_balls(thing)
    shown = len(evaluated(thing).vertices) / 42
    assert 1_000 < shown < 8_000
    assert addon("bridge.nodes.inputs").input_of(modifier, "Merge") > 0
    few = link("Few", np.random.default_rng(2).random((100, 3)))
    assert addon("bridge.nodes.inputs").input_of(groups.add_few_balls(few), "Merge") == 0.0


def test_the_curve_is_refused_where_an_artist_took_the_edges_away():
    torus()
    axis = compute(**CURVE)
    axis.data.clear_geometry()
    refuse("compute the medial axis again|choose Form Curve", "medial_axis_to_curve")
