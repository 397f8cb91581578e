# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliders of the panel run over what can go; what is stored, keyed and kept in files is the length."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from installed import addon
from measure import positions
from scene import compute, ellipsoid, move_vertices, press, reopened, select

EVEN = {"sampling": "SURFACE", "samples": 1_500, "form": "CLEAN"}


def panel():
    return bpy.context.scene.medial_axis


def shown_row(name):
    """The property that the slider shows, and whether it is there to be moved."""
    drawn = SimpleNamespace(
        enabled=True, active=True, prop=lambda _panel, name, slider: shown.append(name)
    )
    drawn.row, shown = lambda align: drawn, []
    result = addon("ui.settings.properties").shown_result(bpy.context)
    addon("ui.base.ranged_sliders").draw_slider(bpy.context, drawn, name, result)
    return shown[0], drawn.enabled and drawn.active


@pytest.fixture
def result():
    return compute(ellipsoid(), select_result=False, **EVEN)


def facets(thing):
    return len(thing.data.polygons)


def test_half_of_a_slider_is_half_of_what_can_go(result):
    whole = facets(result)
    panel().erode_share = 50.0
    assert 0.2 * whole < facets(result) < 0.95 * whole
    assert panel().erode_share == pytest.approx(50.0, abs=0.1)
    assert result["ma_erode"] == pytest.approx(panel().erode) and 0 < panel().erode < 100
    panel().erode_share = 100.0
    assert facets(result) == 0 and panel().erode_share == 100.0
    panel().erode_share = 0.0
    assert facets(result) == whole and panel().erode == 0.0


def test_without_a_range_the_slider_is_grey_and_has_the_same_unit(result):
    assert shown_row("erode") == ("erode_share", True)
    assert shown_row("theta") == ("theta", True) and shown_row("rho") == ("rho", True)
    result["ma_erode_range"] = [0.0, 1.0, 0.0]  # as no version writes it
    assert shown_row("erode") == ("erode_share", False)
    select()
    assert shown_row("simplify") == ("simplify_share", False) and panel().simplify_share == 0.0


def test_a_slider_at_its_end_says_that_little_is_left(result):
    panel().form = "CURVE"
    assert panel().note == "" and len(result.data.edges) > 0
    panel().limb_share = 100.0
    assert not len(result.data.edges) and "points that views do not show" in panel().note
    panel().limb_share = 0.0
    assert panel().note == "" and len(result.data.edges) > 0


def test_detail_is_grey_where_it_takes_nothing_away(result):
    panel().form = "CURVE"
    few = len(result.data.edges)
    panel().detail = 0.0
    assert len(result.data.edges) == few and shown_row("detail") == ("detail", False)
    panel().limb_share, panel().detail = 0.0, 1.0
    many = len(result.data.edges)
    assert shown_row("detail") == ("detail", True) and result["ma_removals"] > 0
    panel().detail = 0.0
    assert len(result.data.edges) < many
    panel().form = "CLEAN"
    assert "ma_removals" not in result


def test_keys_are_of_the_length(result):
    scene = bpy.context.scene
    for frame, length in ((1, 0.0), (11, 2.0)):
        panel().simplify = length
        scene.keyframe_insert("medial_axis.simplify", frame=frame)
    scene.frame_set(11)
    assert panel().simplify == pytest.approx(2.0)
    assert shown_row("simplify")[0] == "simplify" and shown_row("erode")[0] == "erode_share"


def test_files_keep_lengths_and_ranges(result, tmp_path):
    panel().erode_share = 50.0
    length, name = panel().erode, result.name
    reopened(tmp_path / "kept.blend")
    assert panel().erode == pytest.approx(length)
    select(bpy.data.objects[name])
    assert shown_row("erode") == ("erode_share", True)
    assert panel().erode_share == pytest.approx(50.0, abs=0.1)
    panel().erode_share = 25.0
    assert "no longer in memory" in panel().note


def test_simplify_goes_to_the_gap_of_a_noisy_body(tmp_path):
    source = ellipsoid(segments=5)
    noisy = positions(source.data)
    noisy += np.random.default_rng(1).normal(scale=0.014, size=noisy.shape)
    move_vertices(source, noisy)
    settings = {"sampling": "VERTICES", "prepare": "OFF", "form": "CLEAN", "mesh": "VORONOI"}
    result, name = compute(select_result=False, **settings), source.name
    panel().mesh = "VORONOI"
    gap, whole = result["ma_simplify_gap"], facets(result)
    press("medial_axis_simplify_to_gap")
    assert panel().simplify == pytest.approx(gap) and result["ma_simplify"] == pytest.approx(gap)
    assert 0.3 * whole < facets(result) < whole
    panel().simplify = 0.0
    assert facets(result) == whole
    reopened(tmp_path / "kept.blend")
    select(bpy.data.objects[name])
    assert bpy.ops.object.medial_axis_simplify_to_gap.poll()


def test_nothing_is_suggested_without_a_gap(result):
    offered = bpy.ops.object.medial_axis_simplify_to_gap.poll
    assert "ma_simplify_gap" not in result and not offered()
    result["ma_simplify_gap"] = "as no version writes it"
    assert not offered()
    result["ma_simplify_gap"] = 1.0
    assert offered()
    panel().form = "CURVE"
    assert not offered()


def test_a_published_axis_has_no_ranges(result):
    panel().form = "PUBLISHED"
    assert not [key for key in result.keys() if key.endswith("_range")]  # noqa: SIM118
