# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure Thickness: attributes on the source or on a copy, the live limit, thin places, and the feature size."""

import json
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from installed import addon
from mathutils import Vector
from measure import attribute, evaluated, medial_objects, positions
from scene import added, box, ellipsoid, link, press, refuse, ring, scan, select, suzanne, tube_ring
from test_rows import Layout

MEASURE = "medial_axis_thickness"
SIZE = (1.0, 0.7, 0.4)  # of a box


def measure(source, **wanted):
    """Run the operator on a source; what carries the thickness."""
    press(MEASURE, source, **wanted)
    return addon("bridge.thickness.thickness_object").carrier_of(source)


def thin_place(which):
    """Select places that are too thin, or say that there is none."""
    return bpy.ops.object.medial_axis_thin_place(which=which)


def torus(name="Torus"):
    """With as many vertices as it needs."""
    thing = tube_ring(96, 48, 0.25)
    thing.name = name
    return thing


def grid_box():
    """A box with as many vertices as samples."""
    thing = box(*SIZE)
    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.subdivision_type, modifier.levels = "SIMPLE", 6
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    return thing


def thin_faces(thing):
    return attribute(thing.data, "ma_thin").astype(bool)


def test_dense_source_carries_its_thickness_itself():
    source = torus()
    assert measure(source, limit=0.6) == source
    mesh = source.data
    values = attribute(mesh, "ma_thickness")
    assert len(values) == len(mesh.vertices) and 0.4 < np.median(values) < 0.82
    assert mesh.color_attributes.active_color.name == "ma_color"
    assert len(thin_faces(source)) == len(mesh.polygons)
    scale = addon("bridge.thickness.thickness_object").scale_on(source)
    assert (scale.low, scale.limit) == (0.0, pytest.approx(0.6, rel=1e-5)) and scale.high > 0.89
    assert sum(source["ma_thickness_histogram"]) == pytest.approx(1.0, abs=0.01)


def test_coarse_source_has_a_copy_and_its_own_attributes():
    source = box(*SIZE)
    carrier = measure(source, limit=0.41)
    assert carrier != source and carrier.name == source.name + " Thickness"
    assert carrier["ma_source"] == source and len(carrier.data.vertices) > 10_000
    assert attribute(source.data, "ma_thickness") == pytest.approx([0.4] * 8, rel=0.01)
    assert thin_faces(source).all() and thin_faces(carrier).mean() > 0.999
    assert "ma_color" not in source.data.attributes
    assert carrier["ma_thickness_minimum"] == pytest.approx(0.4, rel=0.001)
    assert carrier["ma_thickness_area"] == pytest.approx(2.76, rel=0.001)
    assert measure(source, limit=0.39) == carrier, "it is updated in place"
    assert not thin_faces(source).any() and not thin_faces(carrier).any()


def test_lengths_are_those_of_the_world():
    source = box(*SIZE)
    source.scale, source.rotation_euler = (2.0, 2.0, -2.0), (0.3, 0.2, 0.1)
    carrier = measure(source)
    assert carrier["ma_thickness_minimum"] == pytest.approx(0.8, rel=0.01)
    place = carrier.matrix_world @ Vector(carrier["ma_thickness_place"])
    local = np.abs(source.matrix_world.inverted() @ place)
    assert (local / (0.5, 0.35, 0.2)).max() == pytest.approx(1, rel=0.01)


def test_limit_acts_at_once():
    source, panel = grid_box(), bpy.context.scene.medial_axis_thickness
    assert measure(source, limit=0.1) == source and not thin_faces(source).any()
    panel.limit = 0.41
    assert panel.note == "" and thin_faces(source).all()
    assert source["ma_thickness_share"] == pytest.approx(1.0, abs=1e-3)
    panel.limit = 0.4
    assert not thin_faces(source).any(), "0.4 is not below 0.4"


def test_limit_without_a_measurement_says_what_to_do():
    source, panel = torus(), bpy.context.scene.medial_axis_thickness
    measure(source, limit=0.1)
    addon("core.machine.cache").CACHE.clear()
    panel.limit = 0.7
    assert "no longer in memory" in panel.note
    assert source["ma_thickness_limit"] == pytest.approx(0.1)


def test_places_are_selected_where_one_sees_it():
    source = grid_box()
    measure(source, limit=0.41)
    for mode in ("OBJECT", "EDIT"):
        source.data.polygons.foreach_set("select", [False] * len(source.data.polygons))
        bpy.ops.object.mode_set(mode=mode)
        assert thin_place("ALL") == {"FINISHED"}
        assert source.mode == "EDIT" and bpy.context.tool_settings.mesh_select_mode[2]
        assert source.data.total_face_sel == len(source.data.polygons)
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.mode_set(mode="EDIT")
    assert thin_place("NEXT") == {"FINISHED"}
    assert source["ma_thickness_current"] == 0 and source.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.scene.medial_axis_thickness.limit = 0.39
    assert thin_place("NEXT") == {"CANCELLED"}
    assert thin_place("MINIMUM") == {"FINISHED"}
    assert sum(polygon.select for polygon in source.data.polygons) == 1


def fin():
    """A cube with a fin of 0.002, thinner than the samples are apart."""
    cube = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    corners = [(0.25, 0.499), (0.75, 0.499), (0.75, 0.501), (0.25, 0.501)]
    points = cube + [(x, y, z) for z in (1, 1.1) for x, y in corners]
    faces = [(0, 3, 2, 1), (12, 13, 14, 15)]
    for start in (0, 4, 8):  # the sides of the cube, its top around the fin, the sides of the fin
        rings = [(start + i, start + (i + 1) % 4) for i in range(4)]
        faces += [(i, j, j + 4, i + 4) for i, j in rings]
    return link("Fin", points, faces)


def test_thin_parts_that_only_rays_find_are_seen():
    source = fin()
    carrier, panel = measure(source, limit=0.001), bpy.context.scene.medial_axis_thickness
    assert carrier != source and not thin_faces(carrier).any()
    panel.limit = 0.02
    assert panel.note == ""
    centres = np.array([tuple(p.center) for p in carrier.data.polygons])
    thin = thin_faces(carrier)
    area = np.array([p.area for p in carrier.data.polygons])[thin].sum()
    assert area == pytest.approx(0.1, rel=0.15) and centres[thin][:, 2].min() > 0.97
    used = [v for p in carrier.data.polygons if thin[p.index] for v in p.vertices]
    colours = np.array([tuple(c.color) for c in carrier.data.color_attributes["ma_color"].data])
    assert np.median(colours[used], axis=0)[0] > 0.7
    assert attribute(source.data, "ma_thickness")[8:] == pytest.approx([0.002] * 8, rel=0.01)
    on_fin = [p for p in source.data.polygons if min(p.vertices) >= 8]
    sides = [p.index for p in on_fin if abs(p.normal.y) > 0.9]
    assert len(sides) == 2 and thin_faces(source)[sides].all()
    for thing in (source, carrier):
        for which in ("MINIMUM", "NEXT", "ALL"):
            press("medial_axis_thin_place", thing, which=which)
            bpy.ops.object.mode_set(mode="OBJECT")
            selected = np.array([p.select for p in thing.data.polygons])
            assert selected.any() and thin_faces(thing)[selected].all(), which
        assert np.array_equal(selected, thin_faces(thing))


def test_usual_limits_follow_the_unit_of_the_scene():
    source, units = box(*SIZE), bpy.context.scene.unit_settings
    settings = bpy.context.scene.medial_axis_thickness
    for scale, limit in ((1.0, 0.0012), (0.001, 1.2)):
        units.scale_length = scale
        assert bpy.ops.scene.medial_axis_thickness_limit(millimetres=1.2) == {"FINISHED"}
        assert settings.limit == pytest.approx(limit)
    note = addon("ui.thickness.thickness_limits").unit_note
    units.scale_length = 1.0
    assert note(bpy.context, source) == ""
    source.scale = (80.0, 80.0, 80.0)
    bpy.context.view_layer.update()
    assert "Unit Scale to 0.001" in note(bpy.context, source)


def test_the_legend_has_bars():
    pixels = np.reshape(addon("ui.base.legend")._pixels(((0.1, 0.2, 0.3), 4)), (32, 32, 4))
    assert (pixels[:8, :, 3] == 1.0).all() and (pixels[8:, :, 3] == 0.0).all()


def test_what_was_measured_is_exported(tmp_path):
    source = torus()
    export = bpy.ops.export_scene.medial_axis_thickness
    assert not export.poll()
    measure(source, limit=0.6)
    for suffix in ("html", "csv", "json", "ply"):
        path = tmp_path / f"ring.{suffix}"
        assert export(filepath=str(path)) == {"FINISHED"} and path.stat().st_size > 400
    page = (tmp_path / "ring.html").read_text(encoding="utf-8")
    assert "Thickness of Torus" in page and page.count("data:image/png;base64,") >= 3
    assert "0.6 m" in page
    report = json.loads((tmp_path / "ring.json").read_text(encoding="utf-8"))
    assert report["limit"] == pytest.approx(0.6) and report["unit"] == "m"
    addon("core.machine.cache").CACHE.clear()
    with pytest.raises(RuntimeError, match="press Measure Thickness again"):
        export(filepath=str(tmp_path / "again.html"))
    assert not (tmp_path / "again.html").exists()


def test_a_selection_is_exported_as_one_page(tmp_path):
    """A row for each selected object, also for one that was not measured; other formats have the active object."""
    ring, other = torus(), box(*SIZE)
    other.name = "Never measured"
    export, path = bpy.ops.export_scene.medial_axis_thickness, tmp_path / "parts.html"
    measure(ring, limit=0.6)
    select(ring, other)
    assert export(filepath=str(path)) == {"FINISHED"}
    page = path.read_text(encoding="utf-8")
    assert "Thickness of 2 parts" in page and "of 1 of 2 parts. 1 part could not" in page
    assert "Expected a measurement of &#x27;Never measured&#x27;" in page
    assert page.count("data:image/png;base64,") == 1
    assert export(filepath=str(path), one_page=False) == {"FINISHED"}
    assert "Thickness of Torus" in path.read_text(encoding="utf-8")
    assert export(filepath=str(tmp_path / "parts.csv")) == {"FINISHED"}


def test_edit_mode_and_places_without_a_measurement_are_refused():
    select(torus())
    assert not bpy.ops.object.medial_axis_thin_place.poll()
    bpy.ops.object.mode_set(mode="EDIT")
    refuse("in object mode", operator=MEASURE)
    bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize("make", [scan, lambda: suzanne(2)], ids=["points", "modifiers"])
def test_what_cannot_carry_its_thickness_gets_a_copy(make):
    source = make()
    carrier = measure(source, limit=0.1 if make is scan else 0.2)
    assert carrier != source and len(carrier.data.polygons) > 1000
    assert ("ma_thickness" in source.data.attributes) == (make is scan)
    assert ("reconstructed surface" in carrier["ma_thickness_normals"]) == (make is scan)


def test_several_objects_each_have_their_own():
    first, second = torus("First"), box(*SIZE)
    press(MEASURE, first, second, limit=0.5)
    carrier_of = addon("bridge.thickness.thickness_object").carrier_of
    assert carrier_of(first) == first and carrier_of(second)["ma_source"] == second


def test_copy_stands_for_its_source():
    carrier = measure(box(*SIZE), limit=0.41)
    press(MEASURE, carrier, limit=0.3)
    assert carrier["ma_thickness_limit"] == pytest.approx(0.3)


def test_feature_size_on_the_source():
    source = torus()
    press("medial_axis_sampling_report", source, target="SOURCE")
    sizes = attribute(source.data, "ma_feature_size")
    group = source.vertex_groups["ma_feature_size"]
    weights = np.array([group.weight(i) for i in range(len(sizes))])
    assert weights.min() == 0.0 and weights.max() == 1.0
    assert np.corrcoef(np.log(sizes), weights)[0, 1] < -0.9, "more weight where detail is"


# --- values belong to vertices, whatever modifiers do with their order


def reordered(kind):
    """A flat ellipsoid whose modifiers keep the number of vertices and change their order."""
    source = ellipsoid(axes=(1.0, 0.7, 0.2), segments=4)
    if kind.startswith("BUILD"):
        build = source.modifiers.new("Build", "BUILD")
        build.frame_start, build.frame_duration = 1, 1
        build.use_random_order = True
        build.seed = 7 if kind == "BUILD OTHERWISE" else build.seed
        bpy.context.scene.frame_set(10)
    elif kind == "DEFORM":
        source.modifiers.new("Cast", "CAST").factor = 0.01
    return source


@pytest.mark.parametrize("kind", ["BUILD", "BUILD OTHERWISE", "DEFORM", "NONE"])
def test_thickness_is_of_the_vertex_that_has_it(kind):
    """Looked up by place: the value of each vertex is that of the measured place where it lies."""
    source = reordered(kind)
    carrier, own = measure(source), kind in ("DEFORM", "NONE")
    assert ("ma_thickness" in source.data.attributes) == own
    for mesh in [carrier.data, source.data][: 1 + own]:
        x, y = positions(mesh).T[:2]
        height = 0.4 * np.sqrt(np.maximum(0, 1 - x**2 - (y / 0.7) ** 2))
        values, middle = attribute(mesh, "ma_thickness"), height > 0.25
        assert np.corrcoef(values[middle], height[middle])[0, 1] > 0.9
    assert not [a.name for a in source.data.attributes if "index" in a.name]


@pytest.mark.parametrize("kind", ["BUILD", "DEFORM"])
def test_weights_and_parts_are_of_the_vertex_that_has_them(kind):
    """The bone with most weight is one that is near, also where a modifier reorders the vertices."""
    source = reordered(kind)
    rows = addon("bridge.mesh.evaluated_rows").row_of_vertices(source)
    there, here = positions(evaluated(source))[rows], positions(source.data)
    assert np.abs(there - here).max() < 0.05
    if kind == "BUILD":
        assert not np.array_equal(rows, np.arange(len(rows)))


def test_a_report_is_not_written_on_a_source_in_another_order():
    source = reordered("BUILD")
    wanted = {"target": "SOURCE", "sampling": "VERTICES"}
    refuse("keep the order of vertices", "medial_axis_sampling_report", **wanted)
    assert "ma_epsilon" not in source.data.attributes
    bpy.ops.object.medial_axis_sampling_report(target="COPY", sampling="VERTICES")


@pytest.mark.parametrize("kind", ["surface.nurbs_surface_torus", "object.metaball", "curve"])
def test_thickness_of_what_is_no_mesh_is_on_a_copy(kind):
    """It once ended in a traceback after the whole computation."""
    source = ring() if kind == "curve" else added(kind)
    carrier = measure(source, samples=2000)
    assert carrier != source and carrier["ma_thickness_minimum"] > 0


def test_minimum_is_seen_from_near_also_where_much_is_thin():
    """A plate is thin everywhere, and what is worth seeing is a few times as large as it is thick."""
    carrier = measure(box(1.0, 1.0, 0.1), limit=0.2)
    assert carrier["ma_thickness_area"] > 1.0
    _, size = addon("bridge.thickness.thin_selection").least_of(carrier)
    least = carrier["ma_thickness_minimum"]
    assert 4 * least <= size <= 10 * least < 1.4


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.0, "0 %"), (4e-5, "0.004 %"), (0.071, "7.1 %"), (0.42, "42 %"), (0.996, "100 %"), (1.0, "100 %")],
)  # fmt: skip
def test_shares_are_written_out(share, text):
    assert addon("core.samples.density").share_text(share) == text


def test_one_menu_has_what_f3_looks_for():
    """F3 searches the menus, so whatever can be done with objects is in one."""
    menu = addon("ui.panels.menus").VIEW3D_MT_medial_axis
    menu.draw(SimpleNamespace(layout=(found := Layout())), bpy.context)
    verbs = {
        f"object.{name}"
        for name in dir(bpy.ops.object)
        if name.startswith(("medial_axis", "tight_cocone"))
        and "INTERNAL" not in getattr(bpy.types, f"OBJECT_OT_{name}").bl_options
    }
    # These two are rows of panels, and in another menu.
    at_places = {"object.medial_axis_thin_place", "object.medial_axis_nodes"}
    assert verbs - at_places == {row[0] for row in found.rows if row[0].startswith("object.")}
    for owner in (bpy.types.VIEW3D_MT_object, bpy.types.VIEW3D_MT_object_context_menu):
        entries = owner._dyn_ui_initialize()
        assert sum(entry.__module__.startswith(addon().__name__) for entry in entries) == 1


def test_metaballs_of_one_family_are_one_source(capfd):
    first = added("object.metaball")
    press("medial_axis", added("object.metaball", location=(1.5, 0, 0)), first, form="CLEAN")
    assert "Expected points" not in capfd.readouterr().out
    assert [thing["ma_source"] for thing in medial_objects()] == [first]
