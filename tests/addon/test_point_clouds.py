# SPDX-License-Identifier: GPL-3.0-or-later
"""Point cloud objects, and points that geometry nodes make of a mesh, as sources."""

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, positions, read, world_positions
from scene import added, compute, ellipsoid, new_object, press, refuse, select
from support.clouds import on_ellipsoid


def point_cloud(points, normals=None, name="Cloud"):
    """A point cloud object; Blender before 5.0 gives them a number of points of its own."""
    experimental = bpy.context.preferences.experimental
    if "resize" in bpy.types.PointCloud.bl_rna.functions:
        thing = new_object(name, bpy.data.pointclouds.new(name))
        thing.data.resize(len(points))
    elif hasattr(experimental, "use_new_point_cloud_type"):
        experimental.use_new_point_cloud_type = True
        thing = added("object.pointcloud")
        thing.name = name
    else:
        pytest.skip("this Blender makes no point cloud objects from Python")
    count = len(thing.data.points)
    vectors = np.asarray(points, np.float32)[:count].ravel()
    thing.data.attributes["position"].data.foreach_set("vector", vectors)
    thing.data.update_tag()
    if normals is not None:
        addon("bridge.mesh.attributes").add_normals(thing.data.attributes, normals[:count])
    select(thing)
    return thing


def to_points(source):
    """Geometry nodes that turn the mesh into points."""
    tree = addon("bridge.nodes.tree").Tree("Mesh to Points")
    points = tree.node("GeometryNodeMeshToPoints", named={"Mesh": tree.geometry})
    source.modifiers.new("Points", "NODES").node_group = tree.output(points)
    select(source)


CLOUD = 400  # what pointcloud_add makes


def test_point_cloud_is_read():
    points, _ = on_ellipsoid(CLOUD)
    shape = read(point_cloud(points))
    np.testing.assert_array_equal(shape.points, points.astype(np.float32))
    assert shape.triangles.shape == (0, 3) and shape.normals is None


def test_point_cloud_gives_an_inner_axis():
    source = point_cloud(on_ellipsoid(CLOUD)[0])
    result = compute()
    assert result.name == "Cloud Medial Axis" and result["ma_side"] == "INNER"
    assert result["ma_inside"].startswith("Inside from Tight Cocone: the points have no faces")
    assert set(attribute(result.data, "ma_side")) == {1}
    for thing in (result, source):
        select(thing)
        assert addon("ui.settings.properties").shown_result(bpy.context) == result
    bpy.context.scene.medial_axis.theta = 0.6
    assert result["ma_theta"] == pytest.approx(0.6)


def test_point_cloud_with_normals():
    points, normals = on_ellipsoid(CLOUD)
    source = point_cloud(points, normals)
    source.scale = (-1, 2, 1)
    result = compute(source)
    assert result["ma_inside"] == "Inside from Normals: the points have no faces"
    assert result["ma_warnings"].count("too sparse") == 1 and "\n" not in result["ma_warnings"]
    inside = (world_positions(result) / (1, 1.4, 0.5)) ** 2
    assert inside.sum(axis=1).max() < 1


def test_point_cloud_gives_a_surface():
    source = point_cloud(on_ellipsoid(CLOUD)[0])
    press("tight_cocone_surface")
    surface = addon("bridge.surface_object").surface_of(source)
    assert len(surface.data.vertices) == CLOUD and len(surface.data.polygons) == 2 * CLOUD - 4


def test_empty_point_cloud():
    if not hasattr(bpy.data, "pointclouds"):
        pytest.skip("this Blender has no point clouds")
    select(new_object("Empty", bpy.data.pointclouds.new("Empty")))
    refuse("'Empty': Expected points, found none")


def test_points_that_geometry_nodes_make_of_a_mesh():
    source = ellipsoid()
    before = positions(source.data)
    to_points(source)
    np.testing.assert_array_equal(read(source).points, before)
    result = compute()
    assert (result["ma_sides"], result["ma_points"]) == ("TIGHT_COCONE", len(before))


def test_points_of_another_object_are_not_taken():
    other, source = ellipsoid("Other"), ellipsoid("Mine", segments=2)
    to_points(other)
    count = len(source.data.vertices)
    to_points(source)
    assert len(read(source).points) == count
    source.modifiers.clear()
    source.data.clear_geometry()
    select(source)
    refuse("'Mine': Expected points, found none")
