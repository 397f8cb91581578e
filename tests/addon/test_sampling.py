# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever an artist has, one click: samples of the faces, the axis in the solid, or one clear sentence."""

import math
import time
from functools import partial

import bpy
import numpy as np
import pytest
from installed import addon
from measure import analyses, attribute, positions, read, reports, result_of, sound, watched
from scene import added, move_vertices, press, ring, select, torus


def click(**settings):
    """One click on the button with the defaults of the add-on: the result, or None when there is none."""
    source = bpy.context.object
    answer = bpy.ops.object.medial_axis(**settings)
    result = result_of(source)
    assert answer == ({"CANCELLED"} if result is None else {"FINISHED"})
    return result


# --- the shapes people try first: distance into the solid (negative outside), largest radius


def in_cone(p):
    side = (1.0 - p[:, 2] - 2.0 * np.hypot(p[:, 0], p[:, 1])) / math.sqrt(5.0)
    return np.minimum(side, 1.0 + p[:, 2])


in_ball = lambda p: 1.0 - np.linalg.norm(p, axis=1)
in_cylinder = lambda p: 1.0 - np.maximum(np.hypot(p[:, 0], p[:, 1]), np.abs(p[:, 2]))
SOLIDS = {  # the last: how much the rounding of few flat faces changes, as a share of the radius
    "cube": (lambda p: 1.0 - np.abs(p).max(axis=1), 1.0, 0.05),
    "uv_sphere": (in_ball, 1.0, 0.03),
    "ico_sphere": (in_ball, 1.0, 0.06),
    "cylinder": (in_cylinder, 1.0, 0.05),
    "cone": (in_cone, 2.0 / (1.0 + math.sqrt(5.0)), 0.06),
    "torus": (lambda p: 0.25 - np.hypot(np.hypot(p[:, 0], p[:, 1]) - 1.0, p[:, 2]), 0.25, 0.05),
}


@pytest.mark.parametrize("kind", SOLIDS)
def test_factory_solids(kind):
    depth, largest, rounding = SOLIDS[kind]
    added(kind)
    result = click()
    sound(result)
    if kind != "uv_sphere":  # whose vertices are dense enough for it
        assert result["ma_sampling"] != "VERTICES"
        assert "samples of the surface" in result["ma_sampled"]
    radius = attribute(result.data, "ma_radius")
    assert radius.max() == pytest.approx(largest, rel=rounding)
    inside = depth(positions(result.data))
    assert inside.min() > -1e-6 * largest  # sheets end on the edges
    # A ball round a point of the axis touches the surface: its radius is the depth.
    assert np.abs(inside - radius).max() < rounding * largest
    assert set(attribute(result.data, "ma_side")) <= {1}
    assert tuple(result["ma_betti"]) == (1, int(kind == "torus"), 0)
    assert "as the solid" in result["ma_topology"] and "by its faces" not in result["ma_topology"]


def test_suzanne_as_she_is():
    corners = positions(added("monkey").data)
    result = click()
    sound(result)
    assert result["ma_sampling"] != "VERTICES"
    assert "the surface is open at 42 edges" in result["ma_warnings"]
    where = positions(result.data)
    low, high = corners.min(axis=0) - 1e-6, corners.max(axis=0) + 1e-6  # sheets end on sharp edges
    assert (where > low).all() and (where < high).all()
    assert 0.4 < attribute(result.data, "ma_radius").max() < 0.8


# --- curves, texts, surfaces, metaballs


def test_text_with_a_depth():
    text = added("object.text")
    text.data.extrude = 0.1
    result = click()
    sound(result)
    assert result["ma_sampling"] != "VERTICES" and result["ma_source"] == text
    assert "left out" not in result["ma_warnings"]  # sharp as the tips of letters may be
    assert np.abs(positions(result.data)[:, 2]).max() < 0.1 + 1e-6  # sheets end on the edges
    assert attribute(result.data, "ma_radius").max() < 0.1


def test_curve_with_a_bevel():
    thing = ring()
    result = click()
    sound(result)
    assert attribute(result.data, "ma_radius").max() == pytest.approx(0.2, rel=0.05)
    thing.data.bevel_resolution = 8
    select(thing)
    result = click(sampling="VERTICES")
    assert result["ma_sampling"] == "VERTICES" and result["ma_points"] < 3_000


def test_nurbs_surface():
    added("surface.nurbs_surface_torus")
    sound(click())


def test_metaballs_together():
    ball = added("object.metaball", location=(0, 0, 0))
    ball.data.elements.new().co = (1.5, 0, 0)
    result = click()
    sound(result)
    where = positions(result.data)
    assert where[:, 0].min() < 0.3 and where[:, 0].max() > 1.2  # from one to the other
    assert attribute(result.data, "ma_radius").max() > 0.8
    # A part of the same surface, which belongs to the first.
    part = added("object.metaball", location=(-1.5, 0, 0))
    press("medial_axis")
    assert result_of(part) == result_of(ball)
    assert addon("ui.settings.properties").shown_thing(bpy.context) == result_of(ball)
    assert positions(result_of(ball).data)[:, 0].min() < -1.2


# --- the choices


def test_spacing_is_a_share_of_the_diagonal():
    source, share = torus(), {"sampling": "SURFACE", "spacing": 2.0}
    diagonal = np.linalg.norm(np.ptp(positions(source.data), axis=0))
    result = click(**share)
    area = sum(polygon.area for polygon in source.data.polygons)
    count = 2 * area / (math.sqrt(3) * (0.02 * diagonal) ** 2)
    assert result["ma_points"] == pytest.approx(count, rel=0.1)
    bigger = source.copy()
    bpy.context.scene.collection.objects.link(bigger)
    bigger.scale = (7, 7, 7)
    select(bigger)
    assert click(**share)["ma_points"] == result["ma_points"]


def thin_and_thick():
    """A closed ball that goes over into thin rods."""
    source = added("ico_sphere", subdivisions=5)
    points = positions(source.data)
    points[:, 1:] *= 0.15 + 0.85 * np.exp(-((2.2 * points[:, :1]) ** 2))
    move_vertices(source, points * (3.0, 1.0, 1.0))
    return source


def test_marked_edges_are_sharp():
    source, settings = added("uv_sphere"), {"sampling": "SURFACE", "samples": 2_000}
    assert "with sharp edges" not in click(**settings)["ma_density"]
    heights = positions(source.data)[:, 2]
    for edge in source.data.edges:  # the equator
        edge.use_edge_sharp = bool(np.abs(heights[list(edge.vertices)]).max() < 1e-3)
    select(source)
    assert "with sharp edges" in click(**settings)["ma_density"]


# --- same answer, memory, sliders, cancel


def test_a_second_click_and_the_report_analyse_nothing():
    source = thin_and_thick()
    settings = {"sampling": "ADAPTIVE", "samples": 1_500}
    click(**settings)
    count = analyses()
    assert count > 1  # passes
    select(source)
    click(**settings, theta=0.6)
    bpy.ops.object.medial_axis_sampling_report(**settings)
    assert analyses() == count


def test_epsilon_is_only_counted_again():
    source, settings = torus(), {"sampling": "SURFACE", "samples": 1_500}
    click(**settings)
    count = analyses()
    select(source)
    assert "above 0.1" in click(**settings, epsilon=0.1)["ma_density"]
    assert analyses() == count


def test_sliders_work_on_samples():
    added("cube")
    panel = bpy.context.scene.medial_axis
    panel.crisp = False  # with it sheets lead into the edges at any Theta
    result = click(sampling="SURFACE", samples=3_000)
    count, facets = analyses(), len(result.data.polygons)
    panel.samples = 5_000  # for the next click
    panel.theta = 1.2
    assert len(result.data.polygons) < facets and analyses() == count and panel.note == ""
    assert result["ma_samples"] == 3_000 and result["ma_sampling"] == "SURFACE"
    kept = addon("bridge.axis.axis_object").settings_of(result)
    assert (kept.samples, kept.smooth, kept.sampling.name) == (3_000, True, "SURFACE")


def job_of_a_rod(**settings):
    """A job that takes samples in several passes."""
    core, jobs, shape = addon("core.settings"), addon("core.machine.job"), read(thin_and_thick())
    wanted = core.Settings(sampling=core.SamplingMode.ADAPTIVE, **settings)
    work = partial(addon("core.samples.sampling_report").report_sampling, shape, wanted)
    return jobs.Job([jobs.Task("Rod", work)])


def test_cancel_works_in_every_pass():
    job = job_of_a_rod(samples=200_000, budget=1_000_000, epsilon=0.02)
    seen, end = [], time.monotonic() + 0.1
    while time.monotonic() < end:
        seen.append(job.fraction)
        time.sleep(0.01)
    job.stop()
    assert job.done and seen == sorted(seen)
    with pytest.raises(addon("core.errors").Cancelled):
        job.outcomes()


def test_progress_is_one_bar_over_all_passes():
    job = job_of_a_rod(samples=3_000)
    assert len({stage for stage, _ in watched(job)}) > 3
    assert job.outcomes()[0].value.chosen.sampling.name == "ADAPTIVE"


# --- messy meshes


def test_reports_of_a_click(capfd):
    source = added("cube")
    result = click(sampling="SURFACE", samples=1_000)
    infos = [text for kind, text in reports(capfd) if kind == "Info"]
    assert len(infos) == 1 and set(bpy.data.objects) == {source, result}
    assert infos[0].startswith("Done: 1 piece, ")
