# SPDX-License-Identifier: GPL-3.0-or-later
"""Hollow: a copy of a solid with a cavity, and a drain hole that a modifier cuts."""

import bpy
import numpy as np
import pytest
from measure import evaluated, open_edges, volume, world_positions
from scene import added, press, select

WALL, VOXEL = 0.3, 0.15


def cube(**placed):
    return added("cube", size=2, **placed)


def hollow(source, **options):
    press("medial_axis_hollow", source, wall=WALL, voxel_size=VOXEL, **options)
    return bpy.data.objects["Cube Hollow"]


def shown(thing):
    """Volume and Euler characteristic of what a modifier makes."""
    mesh = evaluated(thing)
    assert open_edges(mesh) == 0
    return volume(mesh), len(mesh.vertices) - len(mesh.edges) + len(mesh.polygons)


def test_a_cube_becomes_a_shell():
    source = cube()
    made = hollow(source)
    assert made.parent == source and len(source.data.polygons) == 6
    assert shown(made) == (pytest.approx(8 - 1.4**3, rel=0.01), 4)
    assert 0.94 * WALL < made["ma_hollow_least"] <= WALL


def test_a_drain_hole_opens_the_lowest_place():
    """The shell becomes one closed surface; a turned cube stands on a corner, where its hole is."""
    turn = (np.arctan(np.sqrt(2)), 0.0, np.pi / 4)
    made = hollow(cube(rotation=turn, location=(3.0, 0.0, 5.0)), drain=0.2)
    assert shown(made)[1] == 2
    cutter = made.modifiers["Medial Axis Drain"].object
    corners = world_positions(cutter)
    np.testing.assert_allclose(corners.mean(axis=0)[:2], (3.0, 0.0), atol=WALL)
    assert corners[:, 2].max() < 5.0
    cutter.location.z += 10.0
    assert shown(made)[1] == 4, "the cylinder can be moved away"


def test_the_cursor_places_the_hole_and_without_a_hole_there_is_no_cylinder():
    source = cube(location=(3.0, 0.0, 0.0))
    bpy.context.scene.cursor.location = (9.0, 0.0, 0.0)
    made = hollow(source, drain=0.2, drain_at="CURSOR")
    corners = world_positions(made.modifiers["Medial Axis Drain"].object)
    assert corners[:, 0].max() > 4.0 and np.abs(corners[:, 1:]).max() < 0.3
    assert hollow(source) == made and not made.modifiers
    assert not any("Drain" in thing.name for thing in bpy.data.objects)


def test_a_second_click_on_the_result_hollows_its_source_again():
    source = cube()
    made = hollow(source)
    before = set(bpy.data.objects)
    select(source, made)
    for _ in range(2):  # with both, and with the result alone, which is selected then
        press("medial_axis_hollow", wall=0.2, voxel_size=0.1)
        assert bpy.context.selected_objects == [made] and set(bpy.data.objects) == before
    assert shown(made)[0] == pytest.approx(8 - 1.6**3, rel=0.01)
