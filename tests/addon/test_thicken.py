# SPDX-License-Identifier: GPL-3.0-or-later
"""Thicken to the Limit: thin walls get the limit, by a modifier on the artist's own mesh, and nothing else moves."""

import bmesh
import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Matrix, Vector
from measure import evaluated, positions
from scene import added, plate, press, refuse

LIMIT = 0.1


def thickness_of(thing):
    """(n,) how thick a plate is at its vertices after its modifiers."""
    bpy.context.view_layer.update()
    return 2.0 * np.abs(positions(evaluated(thing))[:, 2])


@pytest.mark.parametrize("subdivide", [False, True])
def test_a_plate_gets_the_limit_and_keeps_its_outline(subdivide):
    """It needs no subdivision, and a vertex group tells where walls moved."""
    thing = plate(0.02)
    mesh, uvs = thing.data, [tuple(uv.uv) for uv in thing.data.uv_layers[0].data]
    own = positions(mesh)
    press("medial_axis_thicken", limit=LIMIT, subdivide=subdivide)
    np.testing.assert_allclose(thickness_of(thing), LIMIT, rtol=2e-4)
    np.testing.assert_allclose(positions(evaluated(thing))[:, :2], own[:, :2], atol=1e-6)
    assert thing.data == mesh and [tuple(uv.uv) for uv in mesh.uv_layers[0].data] == uvs
    np.testing.assert_array_equal(positions(mesh), own)
    assert [modifier.name for modifier in thing.modifiers] == ["Medial Axis Thicken"]
    group = thing.vertex_groups["Medial Axis Thicken"]
    assert [round(group.weight(v), 6) for v in range(8)] == [1.0] * 8
    assert len(mesh.polygons) == 6


def test_it_is_measured_again_and_not_outdated():
    thing = plate(0.02)
    mesh = bmesh.new()
    mesh.from_mesh(thing.data)
    bmesh.ops.subdivide_edges(mesh, edges=mesh.edges, cuts=7, use_grid_fill=True)
    mesh.to_mesh(thing.data)
    mesh.free()
    bpy.ops.object.medial_axis_thickness(limit=LIMIT)
    of = addon("bridge.thickness.thickness_object")
    assert of.carrier_of(thing)["ma_thickness_share"] == pytest.approx(1.0)
    bpy.ops.object.medial_axis_thicken(limit=LIMIT)
    carrier = of.carrier_of(thing)
    assert carrier["ma_thickness_minimum"] == pytest.approx(LIMIT, rel=2e-4)
    assert carrier["ma_thickness_share"] == 0.0
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    assert not addon("bridge.objects.source_state").has_changed(carrier, depsgraph)


def test_a_second_click_adds_to_the_first_and_the_factor_takes_it_back():
    thing = plate(0.02)
    for limit in (LIMIT, 2 * LIMIT):
        press("medial_axis_thicken", limit=limit)
        np.testing.assert_allclose(thickness_of(thing), limit, rtol=2e-4)
    assert len(thing.modifiers) == 1
    addon("bridge.nodes.inputs").set_inputs(thing.modifiers[0], {"Factor": 0.0})
    np.testing.assert_allclose(thickness_of(thing), 0.02, rtol=1e-5)


def test_scale_rotation_and_mirror():
    thing = plate(0.02)
    turn = Matrix.Rotation(0.7, 3, "X")
    thing.matrix_world = Matrix.LocRotScale(Vector((3.0, 1.0, 2.0)), turn, Vector((2.0, -1.0, 3.0)))
    bpy.context.view_layer.update()
    press("medial_axis_thicken", limit=0.3)
    np.testing.assert_allclose(3.0 * thickness_of(thing), 0.3, rtol=2e-4)
    np.testing.assert_allclose(np.abs(positions(evaluated(thing))[:, :2]), 1.0, rtol=1e-5)


def test_only_selected_faces_move():
    thing = plate(0.02)
    for face in thing.data.polygons:
        face.select = face.normal.z > 0.5
    bpy.ops.object.medial_axis_thicken(limit=LIMIT, moving="SELECTED")
    height = positions(evaluated(thing))[:, 2]
    np.testing.assert_allclose(height.min(), -0.01, rtol=1e-5)
    np.testing.assert_allclose(height.max(), LIMIT - 0.01, rtol=2e-4)


def test_a_group_of_the_artist_that_has_our_name_stays():
    thing = plate(0.02)
    thing.vertex_groups.new(name="Medial Axis Thicken").add([0], 0.25, "REPLACE")
    for limit in (LIMIT, 2 * LIMIT):
        bpy.ops.object.medial_axis_thicken(limit=limit)
    assert len(thing.vertex_groups) == 2 and thing.vertex_groups[0].weight(0) == 0.25
    assert thing.vertex_groups[1].weight(0) == 1.0


def ramp():
    """A plate of six faces that gets thicker along its length, from 0.02 to 0.1, with weights from 0.25 to 0.75."""
    thing = plate(0.02)
    group = thing.vertex_groups.new(name="Along")
    for vertex in thing.data.vertices:
        vertex.co.z *= 3.0 + 2.0 * vertex.co.x
        group.add([vertex.index], 0.25 * vertex.co.x + 0.5, "REPLACE")
    thing.data.update()
    return thing


def test_faces_that_are_thin_in_part_are_subdivided_when_asked():
    """Subdivision keeps coordinates of textures and weights."""
    thing = ramp()
    mesh = thing.data
    refuse("thin in part; Subdivide divides them", "medial_axis_thicken", limit=0.05)
    assert len(mesh.polygons) == 6 and not thing.modifiers
    press("medial_axis_thicken", limit=0.05, subdivide=True, samples=3000)
    assert thing.data == mesh and 300 < len(mesh.polygons) < 10_000
    assert [modifier.name for modifier in thing.modifiers] == ["Medial Axis Thicken"]
    moved, own = positions(evaluated(thing)), positions(mesh)
    np.testing.assert_allclose(np.abs(own[:, 2]), 0.01 * (3.0 + 2.0 * own[:, 0]), rtol=1e-5)
    thickness = 2.0 * np.abs(moved[:, 2])
    # A place on the rim has the thickness of the wall beside it, which is thicker by the taper of a piece.
    inside = np.abs(own[:, :2]).max(axis=1) < 0.99
    assert thickness[inside].min() > 0.05 * 0.999 and thickness.min() > 0.05 * 0.94
    thick = own[:, 0] > 0.8
    assert thick.any() and np.array_equal(moved[thick], own[thick].astype(np.float32))
    weights = [thing.vertex_groups["Along"].weight(v) for v in range(len(own))]
    np.testing.assert_allclose(weights, 0.25 * own[:, 0] + 0.5, atol=1e-5)
    top = [face for face in mesh.polygons if face.normal.z > 0.5]
    assert len(top) > 100
    corners = [corner for face in top for corner in face.loop_indices]
    uv = np.array([mesh.uv_layers[0].data[corner].uv[:] for corner in corners])
    at = np.array([mesh.vertices[mesh.loops[corner].vertex_index].co[:2] for corner in corners])
    _, residual, _, _ = np.linalg.lstsq(np.hstack((at, np.ones((len(at), 1)))), uv, rcond=None)
    assert residual.max() < 1e-6 and np.ptp(uv[:, 0]) > 0.2


def test_selected_faces_of_a_subdivision():
    thing = ramp()
    for face in thing.data.polygons:
        face.select = face.normal.z > 0.5
    bpy.ops.object.medial_axis_thicken(limit=0.05, subdivide=True, samples=3000, moving="SELECTED")
    moved, own = positions(evaluated(thing)), positions(thing.data)
    below = own[:, 2] < 0.0
    np.testing.assert_allclose(moved[below], own[below], atol=1e-7)
    assert moved[:, 2].max() > own[:, 2].max() * 0.999 and (moved[~below] != own[~below]).any()


@pytest.mark.parametrize("subdivided", [True, False])
def test_a_taken_name_is_told_and_nothing_is_left(subdivided):
    thing = ramp() if subdivided else plate(0.02)
    subdivide = {"limit": 0.05, "subdivide": True, "samples": 3000}
    options = subdivide if subdivided else {"limit": LIMIT}
    names = [*thing.vertex_groups.keys(), "ma_thicken"]
    thing.vertex_groups.new(name="ma_thicken")
    refuse("Expected the name 'ma_thicken' to be free", "medial_axis_thicken", **options)
    assert len(thing.data.polygons) == 6 and not thing.modifiers
    assert thing.vertex_groups.keys() == names


def test_a_thick_solid_stays_without_a_modifier():
    added("cube")
    bpy.ops.object.medial_axis_thicken(limit=LIMIT)
    assert not bpy.context.object.modifiers
