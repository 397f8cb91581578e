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
from scene import compute, ellipsoid, in_edit_mode, refuse, reopened, scan, select, suzanne, torus


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


def answer(source, sphere=False, **settings):
    """The compiled module's axis of a source, of the inside if nothing else is said."""
    settings = {"side": addon("core.machine.native").load().Side.INNER} | settings
    return direct(positions(source.data), triangles_of(source.data), sphere, **settings)


def assert_holds(thing, axis):
    """The result object holds these arrays, rounded to float32 and not otherwise."""
    mesh = thing.data
    np.testing.assert_array_equal(positions(mesh), axis.vertices.astype(np.float32))
    for name in ("radius", "theta", "rho"):
        found, exact = attribute(mesh, f"ma_{name}"), getattr(axis, name)
        np.testing.assert_array_equal(found, exact.astype(np.float32))
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
    before = snapshot(source)
    points = positions(evaluated(source))
    result = compute(source)
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


SETTINGS = [
    {"theta": 0.9}, {"rho": 3.0}, {"side": "OUTER"}, {"side": "BOTH"}, {"rule": "BOTH"},
    {"criteria": "ANGLE", "theta": 1.2}, {"criteria": "RATIO"}, {"limit_set": True, "rho": 1.5},
]  # fmt: skip


@pytest.mark.parametrize("settings", SETTINGS, ids=str)
def test_every_setting_reaches_the_compiled_module(settings):
    source = torus()
    result = compute(**settings)
    module = addon("core.machine.native").load()
    enums = {"side": module.Side, "rule": module.Rule, "criteria": module.Criteria}
    wanted = {"side": module.Side.INNER}
    for name, value in settings.items():
        wanted[name] = getattr(enums[name], value) if name in enums else value
        if name in ("theta", "rho"):
            wanted[name] = float(np.float32(value))
        assert result[f"ma_{name}"] == pytest.approx(value)
    sphere = settings.get("side", "INNER") != "INNER"
    axis = answer(source, sphere, **wanted)
    assert_holds(result, axis)
    for name in settings:
        others = {key: value for key, value in wanted.items() if key != name}
        without = answer(source, sphere, **others)
        assert len(axis.theta) != len(without.theta), f"nothing was tested: {name} changed nothing"


def test_modifiers_are_applied_as_the_viewport_shows_them():
    source = ellipsoid(segments=2)
    count = len(source.data.vertices)
    source.modifiers.new("Array", "ARRAY").relative_offset_displace = (2, 0, 0)
    assert compute()["ma_points"] == 2 * count
    source.modifiers["Array"].show_viewport = False
    assert compute(source)["ma_points"] == count


def test_several_selected_objects_give_one_result_each(capfd):
    first, second = ellipsoid("First"), ellipsoid("Second", axes=(1, 1, 0.4))
    compute(first, second)
    assert {thing.name for thing in medial_objects()} == {"First Medial Axis", "Second Medial Axis"}
    assert set(bpy.context.selected_objects) == {result_of(first), result_of(second)}
    assert bpy.context.object == result_of(first)
    infos = [text for kind, text in reports(capfd) if kind == "Info"]
    assert len(infos) == 2 and re.fullmatch(r"Done: \d+ pieces?, \d+\.\d s", infos[0]), infos


def test_one_bad_object_does_not_take_the_others_down():
    good, flat = ellipsoid("Good"), scan("Flat", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)])
    select(good, flat)
    with pytest.raises(RuntimeError, match="'Flat': "):
        bpy.ops.object.medial_axis()
    assert [thing.name for thing in medial_objects()] == ["Good Medial Axis"]


def test_objects_that_are_no_meshes_are_passed_over():
    source = ellipsoid()
    bpy.ops.object.camera_add()
    compute(bpy.context.object, source)
    assert len(medial_objects()) == 1


def test_running_again_updates_the_same_object_whatever_it_is_called():
    source = ellipsoid()
    result = compute()
    first, meshes = len(result.data.polygons), len(bpy.data.meshes)
    result.data.name, source.name, result.name = "My Axis", "Pebble", "Bone"
    assert compute(source, theta=1.0, rho=20.0) == result and medial_objects() == [result]
    assert 0 < len(result.data.polygons) < first
    assert (result.data.name, result.name) == ("My Axis", "Bone") and len(bpy.data.meshes) == meshes
    assert result["ma_theta"] == pytest.approx(1.0)


def test_selected_result_is_computed_from_its_source():
    source = ellipsoid()
    result = compute()
    assert bpy.context.selected_objects == [result]
    compute(theta=1.0)
    assert medial_objects() == [result] and result["ma_theta"] == pytest.approx(1.0)
    assert result["ma_points"] == len(source.data.vertices)


def test_source_deleted_by_the_user_is_gone_although_its_result_points_to_it():
    ellipsoid()
    result = compute(select_result=False)
    bpy.ops.object.delete()
    select(result)
    refuse("source is gone", "object.medial_axis")


def test_moved_and_changed_result_is_put_back_and_keeps_the_artists_choices():
    source = ellipsoid()
    result = compute()
    own = bpy.data.materials.new("Own")
    result.data.materials[0] = own
    result.location, result.show_in_front = (5, 5, 5), False
    copy = bpy.data.objects.new("Linked Duplicate", result.data)
    bpy.context.scene.collection.objects.link(copy)
    compute(source, criteria="ANGLE")
    assert list(result.data.materials) == [own] and not result.show_in_front
    assert copy.data == result.data and len(world_positions(result)) > 0
    assert result.matrix_world.translation.length == 0


def test_material_is_made_once_and_spans_each_objects_own_radii():
    first, second = ellipsoid("First"), ellipsoid("Second", axes=(3, 2, 2))
    compute(first, second)
    assert sum(m.name.startswith("Medial Axis") for m in bpy.data.materials) == 1
    for source in (first, second):
        radius = attribute(result_of(source).data, "ma_radius")
        assert result_of(source)["ma_radius_min"] == pytest.approx(radius.min(), rel=1e-6)
        assert result_of(source)["ma_radius_max"] == pytest.approx(radius.max(), rel=1e-6)


def test_theta_and_rho_are_filtered_from_the_kept_analysis():
    source = torus()
    result, panel = compute(), bpy.context.scene.medial_axis
    before = analyses()
    panel.form = "PUBLISHED"
    counts = {}
    for theta in (0.2, 0.6, 1.2):
        panel.theta = theta
        counts[theta] = len(result.data.polygons)
        assert result["ma_theta"] == pytest.approx(theta)
    assert counts[0.2] >= counts[0.6] >= counts[1.2] > 0 and counts[0.2] > counts[1.2]
    panel.rho = 40.0
    assert len(result.data.polygons) < counts[1.2]
    assert len(compute(source, theta=0.2).data.polygons) == counts[0.2]
    assert analyses() == before
    assert_holds(result, answer(source, theta=float(np.float32(0.2))))


def test_sliders_act_on_the_source_too_and_leave_placement_alone():
    source = ellipsoid()
    result = compute(select_result=False)
    result.location = (3, 0, 0)
    assert bpy.context.object == source
    bpy.context.scene.medial_axis.criteria = "ANGLE"
    assert result["ma_criteria"] == "ANGLE" and tuple(result.location) == (3, 0, 0)


def test_slider_that_leaves_nothing_leaves_the_result_as_it_was():
    result, panel = compute(torus()), bpy.context.scene.medial_axis
    count = len(result.data.polygons)
    panel.form, panel.criteria = "PUBLISHED", "RATIO"
    kept = len(result.data.polygons)
    panel.rho = 1e9
    assert len(result.data.polygons) == kept <= count
    assert "No facet" in panel.note
    panel.rho = 8.0
    assert panel.note == ""


def test_slider_without_kept_analysis_asks_for_compute():
    result, panel = compute(ellipsoid()), bpy.context.scene.medial_axis
    addon("core.machine.cache").CACHE.clear()
    count = len(result.data.polygons)
    panel.theta = 1.2
    assert len(result.data.polygons) == count and "Press Compute Medial Axis" in panel.note


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
    with in_edit_mode():
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.resize(value=(2, 2, 2))
        compute()
        assert source.mode == "EDIT"
    assert np.abs(positions(source.data)).max() == pytest.approx(2.0, rel=0.01)
    assert_holds(result_of(source), answer(source))


def test_edit_mode_sees_modifiers():
    source = ellipsoid(segments=2)
    source.modifiers.new("Subdivision", "SUBSURF").levels = 1
    with in_edit_mode():
        compute()
    count = len(evaluated(source).vertices)
    assert result_of(source)["ma_points"] == count > len(source.data.vertices)


def test_result_in_edit_mode_is_refused():
    result = compute(ellipsoid())
    count = len(result.data.polygons)
    with in_edit_mode():
        words = "in object mode, found it in edit mode; leave that mode"
        refuse(words, "object.medial_axis", theta=1.2)
        bpy.context.scene.medial_axis.theta = 1.2
        assert "object mode" in bpy.context.scene.medial_axis.note
    assert len(result.data.polygons) == count


def test_object_in_two_collections():
    source = ellipsoid()
    other = bpy.data.collections.new("Other")
    bpy.context.scene.collection.children.link(other)
    other.objects.link(source)
    assert set(compute().users_collection) == set(source.users_collection)


def test_result_survives_saving_and_loading(tmp_path):
    count = len(compute(ellipsoid()).data.polygons)
    reopened(tmp_path / "saved.blend")
    source, panel = bpy.data.objects["Ellipsoid"], bpy.context.scene.medial_axis
    assert len(result_of(source).data.polygons) == count
    panel.theta = 1.2
    assert "Press Compute Medial Axis" in panel.note
    assert len(compute(source, theta=1.2).data.polygons) < count and len(medial_objects()) == 1
    assert panel.note == ""


def test_copy_of_a_source_gets_a_result_of_its_own():
    source = ellipsoid()
    compute()
    copy = bpy.data.objects.new("Copy", source.data)
    bpy.context.scene.collection.objects.link(copy)
    copy.location = (4, 0, 0)
    before = analyses()
    compute(copy)
    names = {f"{thing.name} Medial Axis" for thing in (source, copy)}
    assert {thing.name for thing in medial_objects()} == names
    assert analyses() == before, "the same shape elsewhere is the same analysis"
    bpy.context.view_layer.update()
    assert tuple(result_of(copy).matrix_world.translation) == (4, 0, 0)


def drafted(source, **settings):
    """The draft of the first click on a source, by the operator without a window; None where there is none."""
    core = addon("core.settings")
    options = core.OPTIONS | core.LOOKS | core.DIVISION
    values = {
        name: getattr(option.default, "name", option.default) for name, option in options.items()
    }
    operator, shape = SimpleNamespace(**(values | settings)), read(source)
    for name in ("draft", "write", "write_draft", "_show_draft"):
        method = getattr(addon("ui.axis.operators").OBJECT_OT_medial_axis, name)
        setattr(operator, name, MethodType(method, operator))
    work = operator.draft(source, shape)
    if work is None:
        return None
    place = shape.frame, source.matrix_world.copy()
    found = addon("ui.axis.selected_sources").Source(source.name, None, *place)
    job = addon("core.machine.job")
    operator._show_draft(found, job.run_task(job.Task("", work)))
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
