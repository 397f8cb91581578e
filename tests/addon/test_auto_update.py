# SPDX-License-Identifier: GPL-3.0-or-later
"""Auto Update: which result is computed next, and what its updates write; the window's part is a scene."""

import dataclasses

import bpy
import numpy as np
import pytest
from installed import addon
from measure import positions, result_of
from scene import compute, ellipsoid


@pytest.fixture(autouse=True)
def modules():
    """Take the modules of the add-on that is enabled now: other tests enable it again."""
    global auto, live
    auto, live = addon("ui.axis.auto_update"), addon("bridge.axis.live_result")


@pytest.fixture
def pair():
    source = ellipsoid(segments=4)
    bpy.context.scene.medial_axis.sampling = "VERTICES"
    result = compute()
    result.medial_axis_auto_update = True
    addon("bridge.nodes.wires").wires_group()  # as in a window, where the switch makes it
    return source, result


def wanted():
    bpy.context.view_layer.update()
    return auto.next_result(bpy.context)


def edit(source, factor=1.3):
    for vertex in source.data.vertices:
        vertex.co.x *= factor
    source.data.update()


def update(result, coarse=False):
    """Do what the operator does, without its thread."""
    read = read_live(result)
    live.write_live(read, computed(read, wish(result), "draft" if coarse else "shown"), coarse)


def read_live(result):
    return live.read_live(result, bpy.context.evaluated_depsgraph_get())


def wish(result):
    """The settings of the next update."""
    bpy.context.view_layer.update()
    return auto.wish(bpy.context, result)[1]


def computed(read, settings, what="shown"):
    limit = addon("ui.settings.preferences").memory_limit()
    compute = getattr(addon("bridge.axis.shown_axis"), f"compute_{what}")
    return compute(read.shape, settings, read.look, limit)


def test_it_is_off_at_first_and_watches_nothing_in_the_background():
    result = compute(ellipsoid())
    assert not result.medial_axis_auto_update
    result.medial_axis_auto_update = True
    assert auto._after_update not in bpy.app.handlers.depsgraph_update_post
    assert not bpy.app.timers.is_registered(auto._begin)


def test_edits_modifiers_and_scale_are_seen_and_moves_are_not(pair):
    source, result = pair
    assert wanted() is None
    source.location, source.rotation_euler = (1, 2, 3), (0.1, 0.2, 0.3)
    assert wanted() is None
    source.scale = (2, 1, 1)
    assert wanted() == result
    source.scale = (1, 1, 1)
    assert wanted() is None
    wave = source.modifiers.new("Wave", "DISPLACE")
    wave.strength = 0.05
    assert wanted() == result
    result.medial_axis_auto_update = False
    assert wanted() is None


def test_an_update_is_what_a_computation_makes(pair):
    source, result = pair
    edit(source)
    update(result)
    assert wanted() is None
    updated = positions(result.data)
    assert np.array_equal(updated, positions(compute(source, sampling="VERTICES").data))


def test_a_coarse_update_leaves_the_result_outdated(pair):
    source, result = pair
    crisp = wish(result).crisp
    edit(source)
    update(result, coarse=True)
    assert result["ma_sampling"] == "SURFACE" and wanted() == result
    assert wish(result).crisp == crisp, "what was coarse is not wished"
    update(result)
    assert result["ma_sampling"] != "SURFACE" and wanted() is None


def test_filters_stay_those_of_the_result(pair):
    _, result = pair
    result["ma_simplify"] = 0.125
    bpy.context.scene.medial_axis.samples = 900
    assert (wish(result).simplify, wish(result).samples) == (0.125, 900)


def test_what_was_refused_is_tried_again_after_another_edit(pair):
    source, result = pair
    edit(source)
    bpy.context.view_layer.update()
    auto._refused[result.name] = auto.wish(bpy.context, result)
    assert wanted() is None
    edit(source)
    assert wanted() == result
    auto._refused.clear()


def test_sources_in_other_modes_wait_and_deleted_ones_end_it(pair):
    source, result = pair
    edit(source)
    bpy.ops.object.mode_set(mode="SCULPT")
    assert wanted() is None
    bpy.ops.object.mode_set(mode="OBJECT")
    assert wanted() == result
    bpy.data.objects.remove(source)
    assert wanted() is None


def test_a_result_that_went_away_is_not_written(pair):
    source, result = pair
    read = read_live(result)
    bpy.data.objects.remove(result)
    live.write_live(read, None, False)
    assert result_of(source) is None


def test_an_axis_without_facets_is_told_and_not_written(pair):
    _source, result = pair
    read, form = read_live(result), addon("core.settings").Form.PUBLISHED
    settings = dataclasses.replace(wish(result), theta=np.pi / 2, rho=1e9, form=form)
    facets = len(result.data.polygons)
    with pytest.raises(addon("core.errors").MedialAxisError, match="no facet passes"):
        live.write_live(read, computed(read, settings), False)
    assert len(result.data.polygons) == facets > 0


@pytest.mark.parametrize("seed", range(3))
def test_undo_and_redo_step_over_updates(pair, seed):
    """Each step of an artist is one step of undo, whatever updates came between, and nothing is left over."""
    bpy.context.preferences.edit.use_global_undo = True
    names = [thing.name for thing in pair]
    bpy.ops.ed.undo_push(message="set")
    rng, shapes, now = np.random.default_rng(seed), [positions(pair[0].data)], 0
    counts = lambda: (len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.materials))
    kept = counts()
    for step, action in enumerate([2, 0, 1, *rng.integers(4, size=11)]):
        if action == 0 and now > 0:
            now -= bpy.ops.ed.undo() == {"FINISHED"}
        elif action == 1 and now + 1 < len(shapes):
            now += bpy.ops.ed.redo() == {"FINISHED"}
        elif action == 2:
            edit(bpy.data.objects[names[0]], rng.uniform(0.8, 1.25))
            del shapes[now + 1 :]
            shapes.append(positions(bpy.data.objects[names[0]].data))
            now += 1
            bpy.ops.ed.undo_push(message="edit")
        source, result = (bpy.data.objects[name] for name in names)
        assert np.array_equal(positions(source.data), shapes[now]), "a step was lost"
        if wanted() is not None and (step == 0 or rng.random() < 0.8):
            update(result, coarse=step > 0 and rng.random() < 0.3)
        assert kept == counts()
        if wanted() is None:
            assert_belongs(source, result)


def test_an_object_with_the_mesh_of_another_step_is_written_again(pair):
    """Undo may bring back one of the two; which one depends on the Blender."""
    source, result = pair
    edit(source)
    update(result)
    assert wanted() is None
    result.data["ma_written"] = "in another step"
    assert wanted() == result
    update(result)
    assert wanted() is None
    assert_belongs(source, result)


def assert_belongs(source, result):
    """A result that the light calls up to date is the axis of the source."""
    axis = addon("core.axis.compute").compute_axis(read_live(result).shape, wish(result)).axis
    assert np.allclose(positions(result.data), axis.vertices, rtol=0, atol=1e-6)
