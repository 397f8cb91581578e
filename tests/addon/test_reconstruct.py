# SPDX-License-Identifier: GPL-3.0-or-later
"""Reconstruct Surface: the object that is made, made again, or not made at all."""

import bmesh
import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, positions, reports, world_positions
from scene import compute, press, refuse, scan, select, torus
from support.clouds import on_ellipsoid
from test_rows import rows, seen
from test_transforms import PLACES, place


def surface_of(source):
    return addon("bridge.surface_object").surface_of(source)


def reconstruct(*source):
    """The surface of these points, or of the selection."""
    return press("tight_cocone_surface", *source)


def torus_scan():
    return scan("Ring", positions(torus().data))


def two_scans():
    points, _ = on_ellipsoid(1500)
    return scan("Two", np.concatenate([points, points * 0.5 + (3, 0, 0)]))


def assert_closed(thing, euler):
    """Watertight, manifold, outward triangles without loose vertices."""
    mesh = bmesh.new()
    mesh.from_mesh(thing.data)
    try:
        assert all(len(face.verts) == 3 for face in mesh.faces)
        assert all(edge.is_manifold and edge.is_contiguous for edge in mesh.edges)
        assert all(vertex.is_manifold and vertex.link_faces for vertex in mesh.verts)
        assert len(mesh.verts) - len(mesh.edges) + len(mesh.faces) == euler
        assert mesh.calc_volume(signed=True) > 0
    finally:
        mesh.free()


@pytest.mark.parametrize(
    ("make", "euler"), [(scan, 2), (torus_scan, 0), (two_scans, 4)], ids=["ball", "ring", "two"]
)
def test_clean_scan_becomes_a_closed_surface(make, euler, capfd):
    source = make()
    surface = reconstruct()
    assert surface == surface_of(source)
    assert surface.name == f"{source.name} Surface" and surface.type == "MESH"
    assert list(surface.users_collection) == list(source.users_collection)
    assert_closed(surface, euler)
    assert surface.data.validate() is False
    assert not any(polygon.use_smooth for polygon in surface.data.polygons)
    np.testing.assert_array_equal(  # every sample, exactly
        np.unique(positions(surface.data), axis=0), np.unique(positions(source.data), axis=0)
    )
    assert surface["ma_source"] == source and surface["ma_points"] == len(source.data.vertices)
    for figure in ("off_surface", "nonmanifold_edges", "nonmanifold_vertices", "cavities"):
        assert surface[f"ma_{figure}"] == 0
    assert surface["ma_warnings"] == "" and surface["ma_duplicates"] == 0
    assert bpy.context.selected_objects == [surface] == [bpy.context.object]
    kinds, texts = zip(*reports(capfd))
    assert "Warning" not in kinds
    assert f"{len(surface.data.polygons):,} triangles" in texts[-1]
    assert texts[-1].startswith("Done: ") and texts[-1].endswith(" s")


def test_running_again_updates_the_same_object():
    source = scan()
    surface, meshes = reconstruct(), len(bpy.data.meshes)
    surface.data.name = "My Skin"
    own = bpy.data.materials.new("Own")
    surface.data.materials.append(own)
    surface.location = (5, 5, 5)
    source.data.vertices[0].co *= 1.05
    source.data.update()
    reconstruct(source)
    is_surface = addon("bridge.surface_object").is_surface
    assert [*filter(is_surface, bpy.data.objects)] == [surface] and surface.data.name == "My Skin"
    assert list(surface.data.materials) == [own] and len(bpy.data.meshes) == meshes
    bpy.context.view_layer.update()
    assert surface.matrix_world.translation.length == 0
    assert np.abs(positions(surface.data)).max() == np.abs(positions(source.data)).max()


def test_surface_whose_source_is_gone_is_a_mesh_like_any_other():
    source = scan()
    surface = reconstruct()
    bpy.data.objects.remove(source)
    assert reconstruct(surface) == surface_of(surface)
    assert surface_of(surface).name == "Scan Surface Surface"


def test_surface_is_a_source_and_its_axis_that_of_the_scan():
    source = scan()
    first = compute()
    reconstruct(source)
    result = compute()
    assert result.name == "Scan Surface Medial Axis" and first != result
    assert result["ma_inside"] == "Inside from Surface: the faces are closed"
    assert len(result.data.polygons) == len(first.data.polygons)
    radii = [attribute(axis.data, "ma_radius") for axis in (result, first)]
    np.testing.assert_allclose(*radii, rtol=1e-5)


@pytest.mark.parametrize("name", ["mirrored", "everything"])
def test_surface_lies_where_the_points_are(name):
    """Other places: test_transforms.py."""
    source = scan()
    place(source, PLACES[name], name == "everything")
    surface = reconstruct(source)
    bpy.context.view_layer.update()
    assert surface.matrix_world.to_scale()[:] == pytest.approx((1, 1, 1), abs=1e-6)
    assert surface.matrix_world.determinant() > 0
    mine, theirs = world_positions(surface), world_positions(source)
    assert len(mine) == len(theirs)
    np.testing.assert_allclose(mine, theirs, atol=1e-5 * np.ptp(theirs, axis=0).max())
    assert_closed(surface, 2)


def test_refusal_while_another_computation_runs_names_it():
    scan()
    points, _ = on_ellipsoid(300_000)
    work = addon("core.rebuild.reconstruction").reconstruct
    task = addon("core.machine.job").Task("Big", lambda progress: work(points, progress))
    addon("ui.base.current_job").start([task], "surface")
    for operator in ("tight_cocone_surface", "medial_axis"):
        refuse("A surface is being computed; wait", operator=operator)
    addon("ui.base.current_job").stop()


def test_panel_knows_the_surface():
    source = scan()
    surface, properties = reconstruct(), addon("ui.settings.properties")
    assert properties.shown_result(bpy.context) is None
    assert any("triangles" in row[0] for row in rows(seen())), "Result has its figures"
    for thing in (surface, source):
        select(thing)
        assert properties.shown_surface(bpy.context) == surface
    result = compute()
    assert properties.shown_result(bpy.context) == result
