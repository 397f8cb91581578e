# SPDX-License-Identifier: GPL-3.0-or-later
"""Unsolidify: a thin solid becomes sheets with thickness, and Solidify makes the solid of them again."""

import bmesh
import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, evaluated, positions, volume
from scene import link, plate, press

T = 0.05


def unsolidify(*source, **options):
    return press("medial_axis_unsolidify", *source, samples=4000, **options)


def values_of(made, name):
    return [each.value for each in made.data.attributes[name].data]


def test_a_plate_is_one_sheet_with_its_thickness():
    """It has one colour, since it has one thickness, and Solidify gives the plate back."""
    source = plate(T)
    made = unsolidify()
    assert made.name == "Cube Mid-Surface" and made.parent == source
    assert made.show_in_front, "it lies inside the walls"
    np.testing.assert_allclose(np.ptp(positions(made.data), axis=0), (2.0, 2.0, 0.0), atol=1e-5)
    for name in ("ma_thickness", "ma_face_thickness"):
        np.testing.assert_allclose(values_of(made, name), T, rtol=5e-3)
    assert made["ma_color_of"] == "ma_thickness"
    assert made["ma_color_start"] == pytest.approx(T, rel=5e-3)
    np.testing.assert_allclose(attribute(made.data, "ma_color")[:, 0], 0.05, atol=0.1)
    assert made.data.materials[0].name == "Medial Axis Thickness"
    made.modifiers[0].show_viewport = True
    assert volume(evaluated(made)) == pytest.approx(4.0 * T, rel=0.01)


def test_a_bracket_is_two_rectangles():
    """Two legs of 1 and 0.5, 1 deep: the middle of each ends where the other one begins."""
    half, corners = T / 2, [(0, 0), (1, 0), (1, T), (T, T), (T, 0.5), (0, 0.5)]
    points = [(x, y, z) for y in (0.0, 1.0) for x, z in corners]
    sides = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    link("Bracket", points, [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *sides])
    made = unsolidify()
    found = {tuple(round(float(x), 4) + 0.0 for x in each.co) for each in made.data.vertices}
    wanted = {(x, y, z) for x, z in ((half, half), (1.0, half), (half, 0.5)) for y in (0.0, 1.0)}
    assert found == wanted and len(made.data.polygons) == 2
    assert sorted(values_of(made, "ma_part")) == [0, 1]


def test_again_updates_the_same_object():
    source = plate(T)
    made = unsolidify()
    bpy.context.view_layer.objects.active = source
    assert unsolidify(size=0.5) == made and len(made.modifiers) == 1
    ends = positions(made.data)[np.array(made.data.edge_keys)]
    assert 0.2 < np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).max() <= 0.7001


def test_quads_are_a_grid():
    plate(T)
    made = unsolidify(size=0.5, quads=True)
    corners = [len(face.vertices) for face in made.data.polygons]
    assert corners == [4] * 16 and len(made.data.vertices) == 25


def test_thick_parts_are_an_object_of_their_own_by_choice():
    """A bar with a fin on it, as two boxes of one mesh: the bar is kept, and goes when it is not asked for."""
    bar = link("Bar", [])
    bm = bmesh.new()
    outline = [(-1, -1), (1, -1), (1, 1), (T / 2, 1), (T / 2, 3), (-T / 2, 3), (-T / 2, 1), (-1, 1)]
    face = bm.faces.new([bm.verts.new((x, 0.0, z)) for x, z in outline])
    moved = bmesh.ops.extrude_face_region(bm, geom=[face])["geom"]
    verts = [each for each in moved if isinstance(each, bmesh.types.BMVert)]
    bmesh.ops.translate(bm, verts=verts, vec=(0.0, 3.0, 0.0))
    bmesh.ops.recalc_face_normals(bm, faces=bm.faces)
    bm.to_mesh(bar.data)
    bm.free()
    unsolidify(keep_thick=True)
    kept = bpy.data.objects["Bar Thick Parts"]
    assert kept.parent == bar and max(each.co.z for each in kept.data.vertices) < 1.001
    area = sum(face.area for face in kept.data.polygons)
    assert 0.9 < area / (3 * 2 * 3 + 3 * (2 - T) + 2 * 4) < 1.01
    unsolidify(kept)  # it stands for what it was made of
    assert "Bar Thick Parts" not in bpy.data.objects and "Bar Mid-Surface" in bpy.data.objects


def test_it_is_seen_also_where_the_thickness_was_measured_on_a_copy():
    source = plate(T)
    press("medial_axis_thickness")
    copy = addon("bridge.thickness.thickness_object").carrier_of(source)
    assert copy != source and copy.show_in_front
    made = unsolidify(source)
    assert made.show_in_front and not copy.show_in_front
    made.show_in_front = False
    assert unsolidify(source) == made and not made.show_in_front, "what the artist chose stays"
