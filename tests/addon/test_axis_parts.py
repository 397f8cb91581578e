# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets and seams of a medial axis in Blender: attributes, shading, colours, selecting, separating, files."""

import bpy
import numpy as np
import pytest
from installed import addon
from measure import attribute, positions
from scene import added, box, compute, export, press
from test_rows import drawn

EVEN = {"sampling": "SURFACE", "samples": 4_000, "form": "CLEAN"}


@pytest.fixture
def result():
    source = box(3.0, 2.0, 1.0)
    before = sorted(attribute.name for attribute in source.data.attributes)
    axis = compute(**EVEN)
    assert sorted(attribute.name for attribute in source.data.attributes) == before
    return axis


def sharp_edges(mesh):
    return np.array([edge.use_edge_sharp for edge in mesh.edges])


def test_attributes_name_the_parts_of_a_box(result):
    mesh = result.data
    assert set(attribute(mesh, "ma_part").tolist()) == set(range(13))
    seam, kind = attribute(mesh, "ma_seam"), attribute(mesh, "ma_kind")
    assert set(seam.tolist()) == {0, 1, 3}
    assert np.count_nonzero(kind == 2) == 4 and np.count_nonzero(kind == 4) == 8
    assert set(attribute(mesh, "ma_curve").tolist()) == set(range(-1, 24))
    counts = addon("bridge.axis.structure_object").counts_on(result)
    assert list(counts.values()) == [13, 12, 0, 12, 4, 8]


def test_sheets_are_smooth_and_seams_sharp(result):
    mesh = result.data
    assert all(polygon.use_smooth for polygon in mesh.polygons)
    assert np.array_equal(sharp_edges(mesh), attribute(mesh, "ma_seam") == 1)
    if bpy.app.version < (4, 1, 0):
        assert mesh.use_auto_smooth


def test_a_sheet_without_seams_needs_no_normals_of_corners():
    source = added("ico_sphere", subdivisions=4)
    source.scale = (3.0, 2.0, 1.0)
    mesh = compute(source, sampling="VERTICES", form="CLEAN", crisp=False).data
    assert len(mesh.polygons) and all(polygon.use_smooth for polygon in mesh.polygons)
    assert not sharp_edges(mesh).any() and not getattr(mesh, "use_auto_smooth", False)


def test_the_axis_is_read_back_as_it_was_computed(result):
    axis = addon("bridge.axis.read_axis").read_axis(result)
    assert (axis.generators[:, 0] < axis.generators[:, 1]).all()
    first = axis.face_vertices[axis.face_offsets[:-1]]
    assert np.array_equal(first, np.minimum.reduceat(axis.face_vertices, axis.face_offsets[:-1]))
    assert axis.structure.parts == 13
    assert axis.structure.turned.any() and not axis.structure.turned.all()


def test_colours_by_part_are_live(result):
    panel = bpy.context.scene.medial_axis
    panel.by_part = True
    colour = result.data.color_attributes["ma_color"]
    assert colour.domain == "CORNER" and result.data.color_attributes.active_color == colour
    assert len(np.unique(attribute(result.data, "ma_color"), axis=0)) == 13
    assert addon("bridge.mesh.colours").colour_range(result) is None
    panel.by_part = False
    assert result.data.color_attributes["ma_color"].domain == "POINT"


def test_a_part_can_be_selected(result):
    part = attribute(result.data, "ma_part")
    for number, extend, chosen in ((12, False, [12]), (3, True, [12, 3])):
        press("medial_axis_select_part", number=number, extend=extend)
        assert result.mode == "EDIT"
        assert addon("bridge.axis.parts_objects").part_of_active_face(result) in range(13)
        bpy.ops.object.mode_set(mode="OBJECT")
        selected = np.array([polygon.select for polygon in result.data.polygons])
        assert np.array_equal(selected, np.isin(part, chosen))


def test_parts_become_objects_and_are_replaced(result):
    before = positions(result.data)
    for _ in range(2):
        press("medial_axis_separate_parts")
        parts = addon("bridge.axis.parts_objects").parts_of(result)
        (collection,) = {thing.users_collection[0] for thing in parts}
        assert len(parts) == 13 == len(collection.objects)
    assert sum(len(thing.data.polygons) for thing in parts) == len(result.data.polygons)
    assert all(thing.matrix_world == result.matrix_world for thing in parts)
    assert np.array_equal(positions(result.data), before)


def test_other_forms_have_no_parts(result):
    panel = bpy.context.scene.medial_axis
    panel.form = "PUBLISHED"
    assert "ma_part" not in result.data.attributes and "ma_structure" not in result
    assert not bpy.ops.object.medial_axis_separate_parts.poll()
    assert not any(polygon.use_smooth for polygon in result.data.polygons)
    panel.form = "CLEAN"
    assert "ma_part" in result.data.attributes


def test_a_table_is_exported_unless_the_axis_was_changed(result, tmp_path):
    export(tmp_path / "parts.csv")
    rows = (tmp_path / "parts.csv").read_text().splitlines()
    assert rows[0].startswith("part,patch_a,patch_b,area") and len(rows) == 14
    bpy.ops.object.medial_axis_select_part(number=12)
    bpy.ops.mesh.delete(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert addon("bridge.axis.read_axis").read_axis(result).structure is None


def test_details_say_how_many_parts_there_are(result):
    details = bpy.types.VIEW3D_PT_medial_axis_details
    text = ["13 sheets, 12 seams, 12 creases, 4 junctions, 8 corners"]
    assert details.poll(bpy.context) and text in drawn(details)
    compute(bpy.data.objects["Cube"], **EVEN | {"form": "PUBLISHED"})
    assert details.poll(bpy.context) and text not in drawn(details)
    assert not bpy.ops.object.medial_axis_select_part.poll()
    bpy.data.objects.remove(result)
    assert not details.poll(bpy.context)
