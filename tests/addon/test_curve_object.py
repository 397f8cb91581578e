# SPDX-License-Identifier: GPL-3.0-or-later
"""Convert to Curve, and the directions of facets and edges that instances follow."""

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from scene import addon, attribute, compute, ellipsoid, link, positions, result_of, select, torus

CURVE = {"form": "CURVE", "sampling": "SURFACE", "samples": 1_500}


def test_a_curve_has_the_places_and_radii_of_the_wires():
    source = torus()
    source.location = (1.0, 2.0, 3.0)
    compute(**CURVE)
    axis = result_of(source)
    assert bpy.ops.object.medial_axis_to_curve() == {"FINISHED"}
    curve = bpy.context.object
    assert curve.type == "CURVE" and curve.select_get() and not axis.select_get()
    (spline,) = curve.data.splines
    assert spline.use_cyclic_u and len(spline.points) == len(axis.data.vertices)
    places = np.array([point.co[:3] for point in spline.points])
    order = np.lexsort(places.T), np.lexsort(positions(axis.data).T)
    np.testing.assert_array_equal(places[order[0]], positions(axis.data)[order[1]])
    radius = np.array([point.radius for point in spline.points])
    np.testing.assert_allclose(radius[order[0]], attribute(axis.data, "ma_radius")[order[1]])
    bpy.context.view_layer.update()
    assert curve.matrix_world == axis.matrix_world and curve.parent == source


def test_there_is_no_curve_of_sheets_alone():
    ellipsoid()
    compute(sampling="SURFACE", samples=1_500)
    assert not bpy.ops.object.medial_axis_to_curve.poll()


def vectors(mesh, name):
    values = np.empty(3 * len(mesh.attributes[name].data), np.float32)
    mesh.attributes[name].data.foreach_get("vector", values)
    return values.reshape(-1, 3)


def test_normals_are_those_of_the_facets_and_of_length_one():
    source = ellipsoid(segments=4)
    compute(form="CLEAN", sampling="SURFACE", samples=3_000)
    mesh = result_of(source).data
    found = vectors(mesh, "ma_normal")
    assert mesh.attributes["ma_normal"].domain == "FACE"
    blender = np.array([face.normal for face in mesh.polygons])
    area = np.array([face.area for face in mesh.polygons])
    large = area > 0.01 * area.max()  # crisp places may leave a facet no area, and no normal
    np.testing.assert_allclose(np.linalg.norm(found[large], axis=1), 1.0, atol=1e-5)
    assert (np.sum(found * blender, axis=1)[large] > 0.999).all()
    up = np.mean(found[large, 2] > 0)  # the sheet lies in the plane of the two longer axes
    assert max(up, 1 - up) > 0.98, "a sheet has one upper side"


def test_huge_axes_have_normals():
    source = ellipsoid(segments=3)
    source.data.transform(Matrix.Scale(1e37, 4))
    compute(form="CLEAN")
    mesh = result_of(source).data
    length = np.linalg.norm(vectors(mesh, "ma_normal"), axis=1)
    assert np.isclose(length, 1.0, atol=1e-5).mean() > 0.9
    assert mesh.validate() is False


def test_tangents_go_on_along_a_chain():
    source = torus()
    compute(**CURVE)
    mesh = result_of(source).data
    found = vectors(mesh, "ma_tangent")
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0, atol=1e-5)
    middle = np.array([[mesh.vertices[v].co for v in edge.vertices] for edge in mesh.edges])
    turning = np.cross(middle.mean(axis=1), found)[:, 2]
    assert (turning > 0).all() or (turning < 0).all()


def test_the_group_of_balls_shows_thousands():
    thing = link("Many", np.random.default_rng(2).random((60_000, 3)))
    radius = thing.data.attributes.new("ma_radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(60_000, 0.01, np.float32))
    select(thing)
    groups = addon("bridge.nodes.groups")
    modifier = groups.add_few_balls(thing)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    shown = sum(1 for one in depsgraph.object_instances if one.is_instance)
    assert 1_000 < shown < 8_000
    assert addon("bridge.nodes.inputs").input_of(modifier, "Merge") > 0
    few = link("Few", np.random.default_rng(2).random((100, 3)))
    assert addon("bridge.nodes.inputs").input_of(groups.add_few_balls(few), "Merge") == 0.0


def test_the_curve_is_refused_where_an_artist_took_the_edges_away():
    source = torus()
    compute(**CURVE)
    axis = result_of(source)
    axis.data.clear_geometry()
    with pytest.raises(RuntimeError, match="compute the medial axis again|choose Form Curve"):
        bpy.ops.object.medial_axis_to_curve()
