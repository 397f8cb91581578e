# SPDX-License-Identifier: GPL-3.0-or-later
"""Solidify: a closed solid next to a sheet, with its wall as an attribute, also of selected faces alone."""

import bmesh
import bpy
import pytest
from measure import open_edges, volume
from scene import added, press, refuse, select

WALL = 0.2


def grid():
    return added("grid", x_subdivisions=6, y_subdivisions=6, size=2)


def solid(source, **options):
    press("medial_axis_solidify", source, thickness=WALL, **options)
    made = bpy.data.objects[f"{source.name} Solid"]
    assert open_edges(made.data) == 0
    return made


def test_a_grid_becomes_a_plate_in_the_worlds_unit():
    source = grid()
    source.scale = (1.0, 2.0, 1.0)
    made = solid(source, offset=1.0)
    assert volume(made.data) == pytest.approx(2 * 4 * WALL, rel=1e-5)
    walls = [item.value for item in made.data.attributes["ma_wall"].data]
    assert walls == pytest.approx([WALL] * len(made.data.vertices))
    assert min(vertex.co.z for vertex in made.data.vertices) == pytest.approx(0.0, abs=1e-6)
    assert made["ma_solid_least"] == pytest.approx(WALL)


def test_selected_faces_alone_become_a_solid():
    source = grid()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    for face in bmesh.from_edit_mesh(source.data).faces:
        face.select_set(face.calc_center_median().x > 0)
    made = solid(source, only_selected=True)
    assert volume(made.data) == pytest.approx(2 * WALL, rel=1e-5)
    bpy.ops.object.mode_set(mode="OBJECT")
    source.modifiers.new("Subdivision", "SUBSURF")
    select(source)
    refuse("modifiers keep its faces", "medial_axis_solidify", only_selected=True)


def test_another_wall_fills_the_same_object():
    source = grid()
    first = solid(source)
    assert solid(source, offset=-1.0) == first and len(bpy.data.objects) == 2
