# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliders of the panel run over what can go; what is stored, keyed and kept in files is the length."""

import bpy
import numpy as np
import pytest
from scene import addon, compute, ellipsoid, positions, result_of, select

EVEN = {"sampling": "SURFACE", "samples": 1_500, "form": "CLEAN"}


def panel():
    return bpy.context.scene.medial_axis


def shown_row(name):
    sliders, properties = addon("ui.ranged_sliders"), addon("ui.properties")
    return sliders.row_of_slider(bpy.context, name, properties.shown_result(bpy.context))


@pytest.fixture
def result():
    source = ellipsoid()
    compute(**EVEN)
    select(source)
    return result_of(source)


def facets(thing):
    return len(thing.data.polygons)


def test_half_of_a_slider_is_half_of_what_can_go(result):
    whole = facets(result)
    panel().erode_share = 0.5
    assert 0.2 * whole < facets(result) < 0.95 * whole
    assert panel().erode_share == pytest.approx(0.5, abs=1e-3)
    assert result["ma_erode"] == pytest.approx(panel().erode) and 0 < panel().erode < 100
    panel().erode_share = 1.0
    assert facets(result) == 0 and panel().erode_share == 1.0
    panel().erode_share = 0.0
    assert facets(result) == whole and panel().erode == 0.0


def test_without_a_range_the_length_is_shown(result):
    assert shown_row("erode") == "erode_share" and shown_row("simplify") == "simplify_share"
    assert shown_row("theta") == "theta"
    result["ma_erode_range"] = [0.0, 1.0, 0.0]  # as no version writes it
    assert shown_row("erode") == "erode"
    select()
    assert shown_row("simplify") == "simplify"


def test_keys_are_of_the_length(result):
    scene = bpy.context.scene
    for frame, length in ((1, 0.0), (11, 2.0)):
        panel().simplify = length
        scene.keyframe_insert("medial_axis.simplify", frame=frame)
    scene.frame_set(11)
    assert panel().simplify == pytest.approx(2.0)
    assert shown_row("simplify") == "simplify" and shown_row("erode") == "erode_share"


def test_files_keep_lengths_and_ranges(result, tmp_path):
    panel().erode_share = 0.5
    length, name = panel().erode, result.name
    path = str(tmp_path / "kept.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert panel().erode == pytest.approx(length)
    select(bpy.data.objects[name])
    assert shown_row("erode") == "erode_share"
    assert panel().erode_share == pytest.approx(0.5, abs=1e-3)
    panel().erode_share = 0.25
    assert "no longer in memory" in panel().note


def test_simplify_goes_to_the_gap_of_a_noisy_body(tmp_path):
    source = ellipsoid(segments=5)
    noisy = positions(source.data)
    noisy += np.random.default_rng(1).normal(scale=0.014, size=noisy.shape)
    source.data.vertices.foreach_set("co", noisy.astype(np.float32).ravel())
    compute(sampling="VERTICES", prepare="OFF", form="CLEAN", mesh="VORONOI")
    select(source)
    panel().mesh = "VORONOI"
    result, name = result_of(source), source.name
    gap, whole = result["ma_simplify_gap"], facets(result)
    assert bpy.ops.object.medial_axis_simplify_to_gap() == {"FINISHED"}
    assert panel().simplify == pytest.approx(gap) and result["ma_simplify"] == pytest.approx(gap)
    assert 0.3 * whole < facets(result) < whole
    panel().simplify = 0.0
    assert facets(result) == whole
    path = str(tmp_path / "kept.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    select(bpy.data.objects[name])
    assert bpy.ops.object.medial_axis_simplify_to_gap.poll()


def test_nothing_is_suggested_without_a_gap(result):
    assert "ma_simplify_gap" not in result
    assert not bpy.ops.object.medial_axis_simplify_to_gap.poll()
    result["ma_simplify_gap"] = "as no version writes it"
    assert not bpy.ops.object.medial_axis_simplify_to_gap.poll()
    result["ma_simplify_gap"] = 1.0
    assert bpy.ops.object.medial_axis_simplify_to_gap.poll()
    panel().form = "CURVE"
    assert not bpy.ops.object.medial_axis_simplify_to_gap.poll()


def test_a_published_axis_has_the_range_of_rho_only(result):
    panel().form = "PUBLISHED"
    kept = [key for key in result.keys() if key.endswith("_range")]  # noqa: SIM118
    assert kept == ["ma_rho_range"]


def test_rho_runs_from_all_facets_to_those_that_theta_keeps(result):
    panel().form = "PUBLISHED"
    assert shown_row("rho") == "rho_share" and result["ma_rho"] == panel().rho == 8.0
    panel().rho_share = 0.0
    whole = facets(result)
    panel().rho_share = 1.0
    least = facets(result)
    assert least < 0.8 * whole  # else the test sees nothing
    panel().rho_share = 0.5
    assert facets(result) == pytest.approx(0.5 * (whole + least), rel=0.02)
    assert result["ma_rho"] == pytest.approx(panel().rho) and 1.0 < panel().rho < 8.0
    panel().criteria = "ANGLE"
    assert shown_row("rho") == "rho"
