# SPDX-License-Identifier: GPL-3.0-or-later
"""Compute Medial Axis on real objects: what is made, what it is called, what stays as it was."""

import re
from types import MethodType, SimpleNamespace

import bpy
import numpy as np
import pytest
from installed import addon
from measure import (
    analyses,
    attribute,
    direct,
    evaluated,
    generators,
    medial_objects,
    positions,
    read,
    reports,
    result_of,
    triangles_of,
    world_positions,
)
from scene import compute, ellipsoid, link, refuse, reopened, scan, select, suzanne, torus


def snapshot(thing):
    """Everything of an object that a computation must not touch."""
    mesh = thing.data
    return (
        thing.name,
        mesh.name,
        positions(mesh).tobytes(),
        triangles_of(mesh).tobytes(),
        [(m.name, m.type, m.show_viewport, getattr(m, "levels", None)) for m in thing.modifiers],
        [list(row) for row in thing.matrix_world],
        thing.parent,
        thing.hide_get(),
        thing.display_type,
        [c.name for c in thing.users_collection],
        dict(thing.items()),
        [slot.name for slot in thing.material_slots],
        [a.name for a in mesh.attributes],
    )


def assert_holds(thing, axis):
    """The result object holds these arrays, rounded to float32 and not otherwise."""
    mesh = thing.data
    np.testing.assert_array_equal(positions(mesh), axis.vertices.astype(np.float32))
    np.testing.assert_array_equal(attribute(mesh, "ma_radius"), axis.radius.astype(np.float32))
    np.testing.assert_array_equal(attribute(mesh, "ma_theta"), axis.theta.astype(np.float32))
    np.testing.assert_array_equal(attribute(mesh, "ma_rho"), axis.rho.astype(np.float32))
    np.testing.assert_array_equal(attribute(mesh, "ma_side"), axis.side)
    np.testing.assert_array_equal(generators(mesh), axis.generators)
    corners = [loop.vertex_index for loop in mesh.loops]
    starts = [polygon.loop_start for polygon in mesh.polygons]
    np.testing.assert_array_equal(corners, axis.face_vertices)
    np.testing.assert_array_equal(starts, axis.face_offsets[:-1])


def test_subdivided_suzanne():
    source = suzanne(levels=1)
    collection = bpy.data.collections.new("Animals")
    bpy.context.scene.collection.children.link(collection)
    for other in source.users_collection:
        other.objects.unlink(source)
    collection.objects.link(source)
    select(source)
    before = snapshot(source)
    points = positions(evaluated(source))
    result = compute()
    assert result.name == "Suzanne Medial Axis"
    assert list(result.users_collection) == [collection]
    assert snapshot(source) == before
    assert len(medial_objects()) == 1
    mesh = result.data
    assert mesh.validate() is False
    assert not any(polygon.use_smooth for polygon in mesh.polygons)
    assert [m.name for m in mesh.materials] == ["Medial Axis Radius"]
    assert result["ma_points"] == len(points) == 2012
    radius = attribute(mesh, "ma_radius")
    assert np.isfinite(positions(mesh)).all() and (radius > 0).all()
    some = np.random.default_rng(1).choice(len(radius), 300)
    nearest = np.linalg.norm(positions(mesh)[some, None] - points, axis=2).min(axis=1)
    np.testing.assert_allclose(radius[some], nearest, rtol=1e-4, atol=1e-5)


def test_result_is_the_compiled_modules_answer():
    source = ellipsoid()
    compute()
    points, triangles = positions(source.data), triangles_of(source.data)
    module = addon("core.machine.native").load()
    assert result_of(source)["ma_side"] == "INNER"
    assert_holds(result_of(source), direct(points, triangles, side=module.Side.INNER))


@pytest.mark.parametrize(
    "settings",
    [
        {"theta": 0.9},
        {"rho": 3.0},
        {"side": "OUTER"},
        {"side": "BOTH"},
        {"rule": "BOTH"},
        {"criteria": "ANGLE", "theta": 1.2},
        {"criteria": "RATIO"},
        {"limit_set": True, "rho": 1.5},
    ],
    ids=str,
)
def test_every_setting_reaches_the_compiled_module(settings):
    source = torus()
    compute(**settings)
    module = addon("core.machine.native").load()
    enums = {"side": module.Side, "rule": module.Rule, "criteria": module.Criteria}
    wanted = {"side": module.Side.INNER}
    for name, value in settings.items():
        wanted[name] = getattr(enums[name], value) if name in enums else value
    for name in ("theta", "rho"):
        if name in wanted:
            wanted[name] = float(np.float32(wanted[name]))
    sphere = settings.get("side", "INNER") != "INNER"
    points, triangles = positions(source.data), triangles_of(source.data)
    axis = direct(points, triangles, sphere, **wanted)
    assert_holds(result_of(source), axis)
    for name in settings:
        others = {key: value for key, value in wanted.items() if key != name or name == "side"}
        others["side"] = module.Side.INNER if name == "side" else others["side"]
        without = direct(points, triangles, sphere, **others)
        assert len(axis.theta) != len(without.theta), (
            f"{name} changed nothing, so nothing was tested"
        )
    for name, value in settings.items():
        assert result_of(source)[f"ma_{name}"] == pytest.approx(value)


def test_modifiers_are_applied_as_the_viewport_shows_them():
    source = ellipsoid(segments=2)
    count = len(source.data.vertices)
    source.modifiers.new("Array", "ARRAY").relative_offset_displace = (2, 0, 0)
    compute()
    assert result_of(source)["ma_points"] == 2 * count
    source.modifiers["Array"].show_viewport = False
    compute(source)
    assert result_of(source)["ma_points"] == count


def test_several_selected_objects_give_one_result_each(capfd):
    first, second = ellipsoid("First"), ellipsoid("Second", axes=(1, 1, 0.4))
    select(first, second)
    compute()
    assert {thing.name for thing in medial_objects()} == {"First Medial Axis", "Second Medial Axis"}
    assert set(bpy.context.selected_objects) == {result_of(first), result_of(second)}
    assert bpy.context.object == result_of(first)
    infos = [text for kind, text in reports(capfd) if kind == "Info"]
    assert len(infos) == 2 and re.fullmatch(r"Done: \d+ pieces?, \d+\.\d s", infos[0]), infos


def test_one_bad_object_does_not_take_the_others_down():
    good, flat = ellipsoid("Good"), link("Flat", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)])
    select(good, flat)
    with pytest.raises(RuntimeError, match="'Flat': "):
        bpy.ops.object.medial_axis()
    assert [thing.name for thing in medial_objects()] == ["Good Medial Axis"]


def test_objects_that_are_no_meshes_are_passed_over():
    source = ellipsoid()
    bpy.ops.object.camera_add()
    select(bpy.context.object, source)
    compute()
    assert len(medial_objects()) == 1


def test_running_again_updates_the_same_object():
    source = ellipsoid()
    result = compute()
    result.data.name = "My Axis"
    first = len(result.data.polygons)
    meshes = len(bpy.data.meshes)
    compute(source, theta=1.0, rho=20.0)
    assert result_of(source) == result and len(medial_objects()) == 1
    assert 0 < len(result.data.polygons) < first
    assert result.data.name == "My Axis" and len(bpy.data.meshes) == meshes
    assert result["ma_theta"] == pytest.approx(1.0)


def test_renamed_source_and_result_are_found_again():
    source = ellipsoid()
    result = compute()
    source.name, result.name = "Pebble", "Bone"
    compute(source, theta=1.0)
    assert medial_objects() == [result] and result.name == "Bone"


def test_selected_result_is_computed_from_its_source():
    source = ellipsoid()
    result = compute()
    assert bpy.context.selected_objects == [result]
    compute(theta=1.0)
    assert medial_objects() == [result] and result["ma_theta"] == pytest.approx(1.0)
    assert result["ma_points"] == len(source.data.vertices)


def test_source_deleted_by_the_user_is_gone_although_its_result_points_to_it():
    source = ellipsoid()
    result = compute()
    select(source)
    bpy.ops.object.delete()
    select(result)
    refuse("source is gone", "object.medial_axis")


def test_moved_and_changed_result_is_put_back_and_keeps_the_artists_choices():
    source = ellipsoid()
    result = compute()
    lies = world_positions(result)
    own = bpy.data.materials.new("Own")
    result.data.materials[0] = own
    result.location, result.show_in_front = (5, 5, 5), False
    copy = bpy.data.objects.new("Linked Duplicate", result.data)
    bpy.context.scene.collection.objects.link(copy)
    compute(source, criteria="ANGLE")
    assert list(result.data.materials) == [own] and not result.show_in_front
    assert copy.data == result.data
    bpy.context.view_layer.update()
    assert result.matrix_world.translation.length == 0
    assert len(lies) > 0


def test_material_is_made_once_and_spans_each_objects_own_radii():
    first, second = ellipsoid("First"), ellipsoid("Second", axes=(3, 2, 2))
    select(first, second)
    compute()
    materials = [m for m in bpy.data.materials if m.name.startswith("Medial Axis")]
    assert len(materials) == 1
    for source in (first, second):
        radius = attribute(result_of(source).data, "ma_radius")
        assert result_of(source)["ma_radius_min"] == pytest.approx(radius.min(), rel=1e-6)
        assert result_of(source)["ma_radius_max"] == pytest.approx(radius.max(), rel=1e-6)


def test_theta_and_rho_are_filtered_from_the_kept_analysis():
    source = torus()
    compute()
    before = analyses()
    panel = bpy.context.scene.medial_axis
    panel.form = "PUBLISHED"
    counts = {}
    for theta in (0.2, 0.6, 1.2):
        panel.theta = theta
        counts[theta] = len(result_of(source).data.polygons)
        assert result_of(source)["ma_theta"] == pytest.approx(theta)
    assert counts[0.2] >= counts[0.6] >= counts[1.2] > 0 and counts[0.2] > counts[1.2]
    panel.rho = 40.0
    assert len(result_of(source).data.polygons) < counts[1.2]
    compute(source, theta=0.2)
    assert len(result_of(source).data.polygons) == counts[0.2]
    assert analyses() == before
    module = addon("core.machine.native").load()
    points, triangles = positions(source.data), triangles_of(source.data)
    theta = float(np.float32(0.2))
    assert_holds(result_of(source), direct(points, triangles, side=module.Side.INNER, theta=theta))


def test_sliders_act_on_the_source_too_and_leave_placement_alone():
    source = ellipsoid()
    result = compute()
    result.location = (3, 0, 0)
    select(source)
    bpy.context.scene.medial_axis.criteria = "ANGLE"
    assert result["ma_criteria"] == "ANGLE" and tuple(result.location) == (3, 0, 0)


def test_slider_that_leaves_nothing_leaves_the_result_as_it_was():
    result = compute(torus())
    count = len(result.data.polygons)
    panel = bpy.context.scene.medial_axis
    panel.form = "PUBLISHED"
    panel.criteria = "RATIO"
    kept = len(result.data.polygons)
    panel.rho = 1e9
    assert len(result.data.polygons) == kept <= count
    assert "No facet" in panel.note
    panel.rho = 8.0
    assert panel.note == ""


def test_slider_without_kept_analysis_asks_for_compute():
    result = compute(ellipsoid())
    addon("core.machine.cache").CACHE.clear()
    count = len(result.data.polygons)
    bpy.context.scene.medial_axis.theta = 1.2
    assert len(result.data.polygons) == count
    assert "Press Compute Medial Axis" in bpy.context.scene.medial_axis.note


def test_changed_mesh_is_analysed_again():
    source = ellipsoid()
    compute()
    before = analyses()
    source.data.vertices[0].co *= 1.01
    source.data.update()
    compute(source)
    assert analyses() == before + 1


def test_edit_mode_is_flushed_not_refused():
    source = ellipsoid()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.resize(value=(2, 2, 2))
    compute()
    assert source.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    points = positions(source.data)
    assert np.abs(points).max() == pytest.approx(2.0, rel=0.01)
    module = addon("core.machine.native").load()
    assert_holds(
        result_of(source), direct(points, triangles_of(source.data), side=module.Side.INNER)
    )


def test_edit_mode_sees_modifiers():
    source = ellipsoid(segments=2)
    source.modifiers.new("Subdivision", "SUBSURF").levels = 1
    bpy.ops.object.mode_set(mode="EDIT")
    compute()
    bpy.ops.object.mode_set(mode="OBJECT")
    count = len(evaluated(source).vertices)
    assert result_of(source)["ma_points"] == count > len(source.data.vertices)


def test_result_in_edit_mode_is_refused():
    ellipsoid()
    result = compute()
    count = len(result.data.polygons)
    bpy.ops.object.mode_set(mode="EDIT")
    refuse(
        "in object mode, found it in edit mode; leave that mode", "object.medial_axis", theta=1.2
    )
    bpy.context.scene.medial_axis.theta = 1.2
    assert "object mode" in bpy.context.scene.medial_axis.note
    bpy.ops.object.mode_set(mode="OBJECT")
    assert len(result.data.polygons) == count


def test_object_in_two_collections():
    source = ellipsoid()
    other = bpy.data.collections.new("Other")
    bpy.context.scene.collection.children.link(other)
    other.objects.link(source)
    compute()
    assert set(result_of(source).users_collection) == set(source.users_collection)


def test_result_survives_saving_and_loading(tmp_path):
    source = ellipsoid()
    compute()
    count = len(result_of(source).data.polygons)
    reopened(tmp_path / "saved.blend")
    source = bpy.data.objects["Ellipsoid"]
    assert len(result_of(source).data.polygons) == count
    bpy.context.scene.medial_axis.theta = 1.2
    assert "Press Compute Medial Axis" in bpy.context.scene.medial_axis.note
    compute(source, theta=1.2)
    assert len(medial_objects()) == 1 and len(result_of(source).data.polygons) < count
    assert bpy.context.scene.medial_axis.note == ""


def test_copy_of_a_source_gets_a_result_of_its_own():
    source = ellipsoid()
    compute()
    copy = bpy.data.objects.new("Copy", source.data)
    copy.location = (4, 0, 0)
    bpy.context.scene.collection.objects.link(copy)
    select(copy)
    before = analyses()
    compute()
    assert {thing.name for thing in medial_objects()} == {
        "Ellipsoid Medial Axis",
        "Copy Medial Axis",
    }
    assert analyses() == before, "the same shape elsewhere is the same analysis"
    bpy.context.view_layer.update()
    assert tuple(result_of(copy).matrix_world.translation) == (4, 0, 0)


def operator_of(**settings):
    """The operator without a window, with the settings that it would have."""
    core = addon("core.settings")
    options = core.OPTIONS | core.LOOKS | core.DIVISION
    values = {
        name: getattr(option.default, "name", option.default) for name, option in options.items()
    }
    kind = addon("ui.axis.operators").OBJECT_OT_medial_axis
    thing = SimpleNamespace(**(values | settings))
    for name in ("draft", "write", "write_draft", "_show_draft"):
        setattr(thing, name, MethodType(getattr(kind, name), thing))
    return thing


def drafted(source, **settings):
    """The draft of the first click on a source; None where there is none."""
    operator, shape = operator_of(**settings), read(source)
    work = operator.draft(source, shape)
    if work is None:
        return None
    found = addon("ui.axis.selected_sources").Source(
        source.name, None, shape.frame, source.matrix_world.copy()
    )
    outcome = addon("core.machine.job").run_task(addon("core.machine.job").Task("", work))
    operator._show_draft(found, outcome)
    assert operator._kept
    return result_of(source)


def test_a_first_click_shows_a_draft_whose_place_the_exact_axis_takes():
    figures = addon("ui.axis.figures")
    source = suzanne(levels=0)
    draft = drafted(source)
    assert draft["ma_draft"] and draft["ma_points"] < 5_000 and draft.parent == source
    assert figures.why_outdated(bpy.context, draft) == "A draft, of few samples"
    assert drafted(source) is None, "there is a result"
    select(source)
    assert bpy.ops.object.medial_axis() == {"FINISHED"}
    exact = result_of(source)
    assert exact == draft and "ma_draft" not in exact and exact["ma_points"] > 5_000
    assert figures.why_outdated(bpy.context, exact) == ""


def test_what_is_quick_has_no_draft_but_many_points_have_one(monkeypatch):
    assert drafted(ellipsoid(), sampling="VERTICES") is drafted(scan()) is None
    monkeypatch.setattr(addon("core.samples.thinning"), "COARSE", 500)
    draft = drafted(scan("Many"))
    assert draft["ma_draft"] and 250 < draft["ma_points"] <= 500
