# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves with less detail, and their smooth lines."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.axis.compute import compute_axis, refilter, refiltered_topology
from medial_axis.core.axis.extract import extract
from medial_axis.core.axis.levels import hierarchy_of
from medial_axis.core.curves.net import Net
from medial_axis.core.curves.removals import recorded
from medial_axis.core.curves.smooth_line import Course, smooth_between
from medial_axis.core.settings import Form, SamplingMode, Settings, SkeletonSettings
from medial_axis.core.skeleton.compute import compute_skeleton
from support.inputs import of_any_processor
from support.levels import betti_of_mesh, tips
from support.meshes import capsule, flip, icosphere, join, moved, shape_of, torus

DETAILS = (1.0, 0.75, 0.5, 0.25, 0.0)


def tongs():
    """Two arms a tenth of a radius apart, which the samples join by rungs."""
    arms = capsule((0, 0, 0), (4, 0, 0), 0.3), capsule((0, 0.63, 0), (4, 0.63, 0), 0.3)
    return join(*arms, capsule((0, 0, 0), (0, 0.63, 0), 0.3))


def bells():
    """Two hollow balls on a bar."""
    ball = join(icosphere(3), flip(icosphere(3, 0.4)))
    return join(ball, moved(ball, (4, 0, 0)), capsule((0.7, 0, 0), (3.3, 0, 0), 0.3))


SOLIDS = {"tongs": (tongs, 1_200), "bells": (bells, 2_500), "torus": (torus, 1_000)}


@pytest.fixture(scope="module")
def curves():
    """{solid: (its computation, {detail: smooth curve}, {detail: curve along the wires})}."""
    found = {}
    for name, (solid, samples) in SOLIDS.items():
        settings = Settings(form=Form.CURVE, sampling=SamplingMode.SURFACE, samples=samples)
        computation = compute_axis(shape_of(solid()), settings)
        smooth, raw = {}, {}
        for detail in DETAILS:
            wanted = replace(computation.settings, detail=detail)
            smooth[detail] = refilter(computation.key, wanted)
            raw[detail] = extract(computation.chosen.samples, wanted, relaxed=False)
        found[name] = computation, smooth, raw
    return found


@pytest.mark.parametrize("detail", DETAILS)
@pytest.mark.parametrize("name", SOLIDS)
def test_betti_numbers_are_those_of_the_cells(curves, name, detail):
    _computation, smooth, raw = curves[name]
    for axis in (smooth[detail], raw[detail]):
        pieces, loops, cavities = axis.level.betti
        assert betti_of_mesh(axis, axis.edges) == (pieces, pieces - loops + cavities)
        assert len(axis.level.limb) == len(axis.edges)
        rows = ("exact", "exact_radius", "place", "crumb")
        assert {len(getattr(axis.level, row)) for row in rows} == {len(axis.vertices)}
        assert axis.structure is None or len(axis.structure.kind) == len(axis.vertices)


def test_at_full_detail_nothing_is_left_out(curves):
    for name, betti in (("tongs", (1, 21, 0)), ("bells", (1, 0, 2)), ("torus", (1, 1, 0))):
        for found in curves[name][1:]:
            assert found[1.0].level.betti == betti and not found[1.0].level.loops_left_out


def test_less_detail_has_only_what_more_has(curves):
    wires = {
        detail: {tuple(sorted(map(tuple, edge))) for edge in axis.vertices[axis.edges].tolist()}
        for detail, axis in curves["tongs"][2].items()
    }
    for more, less in itertools.pairwise(DETAILS):
        assert wires[less] < wires[more]
    loops = [axis.level.betti[1] for axis in curves["tongs"][1].values()]
    assert loops == sorted(loops, reverse=True) and loops[-1] == 0 and loops[0] > loops[2] > 0


def test_without_detail_the_curve_has_the_branches_of_the_skeleton(curves):
    for name in ("tongs", "torus"):
        computation, smooth, _ = curves[name]
        shape = shape_of(SOLIDS[name][0]())
        found = compute_skeleton(shape, computation.settings, SkeletonSettings()).skeleton
        axis = smooth[0.0]
        assert (tips(axis, axis.edges), axis.level.betti[1]) == (found.tips, found.loops)


@pytest.mark.parametrize("samples", [1_000, 1_500, 2_000])
def test_arms_that_touch_at_their_ends_stay(samples):
    """The last rung leads from end to end, so that the arms beyond the last but one are a part of a loop."""
    settings = Settings(form=Form.CURVE, sampling=SamplingMode.SURFACE, samples=samples, detail=0.0)
    axis = compute_axis(shape_of(of_any_processor(tongs())), settings).axis
    far = axis.vertices[axis.vertices[:, 0] > 3.5, 1]
    assert axis.level.betti == (1, 0, 0) and tips(axis, axis.edges) == 2
    assert far.min() < 0.1 and far.max() > 0.5


def test_loops_that_are_left_out_are_told(curves):
    computation, smooth, _ = curves["tongs"]
    said = refiltered_topology(computation.key, smooth[0.0], Form.CURVE)
    assert said == "1 piece, no loop, no cavity, with less detail than the samples show"
    said = refiltered_topology(curves["torus"][0].key, curves["torus"][1][0.0], Form.CURVE)
    assert said == "1 piece, 1 loop, no cavity, as the solid"


def test_what_closed_sheets_hold_stays(curves):
    axis = curves["bells"][1][0.0]
    assert axis.facets > 100 and len(axis.edges) > 3 and axis.level.betti == (1, 0, 2)


@pytest.mark.parametrize("name", SOLIDS)
def test_no_line_leaves_the_solid(medial, curves, name):
    """Rungs across the gap of the tongs stay as the level has them."""
    computation, smooth, _ = curves[name]
    samples, solid = computation.chosen.samples, computation.chosen.samples.solid.shape
    hierarchy = hierarchy_of(samples, computation.settings, None)
    level = hierarchy.extract(sheet=math.inf, limb=0.04, crisp=True, relaxed=True)
    given = set(map(tuple, level.vertices.tolist()))
    for detail, axis in smooth.items():
        winding = medial.winding_number(axis.vertices, solid.points, solid.triangles)
        outside = set(map(tuple, axis.vertices[winding < 0.5].tolist()))
        assert outside <= given
        assert not outside or (name == "tongs" and detail > 0.0)


def test_the_line_in_a_torus_is_a_circle_with_its_balls(curves):
    axis = curves["torus"][1][1.0]
    away = np.hypot(np.hypot(*axis.vertices[:, :2].T) - 1.0, axis.vertices[:, 2])
    assert away.max() < 0.001 and np.abs(axis.radius - 0.4).max() < 0.002
    steps = np.linalg.norm(np.diff(axis.vertices[axis.edges], axis=1)[:, 0], axis=1)
    assert steps.sum() == pytest.approx(2 * np.pi, rel=0.002) and steps.max() < 1.1 * steps.min()


def test_lines_do_not_zigzag(curves):
    """The arms lie in a plane of constant z, across which wires go to and fro."""
    _, smooth, raw = curves["tongs"]

    def turns(axis):
        ends = axis.vertices[axis.edges]
        way = ends[:, 1] - ends[:, 0]
        return np.abs(way[:, 2]).sum()

    for detail in DETAILS:
        assert turns(smooth[detail]) < 0.5 * turns(raw[detail])


# --- parts


def test_removals_are_recorded_as_arrays():
    points = np.array(
        [(0, 0, 0), (1, 1, 0), (1, -1, 0), (2, 0, 0), (3, 0, 0), (2, 2, 0), (1, 2, 0)], float
    )
    wires = np.array([(0, 1), (1, 3), (0, 2), (2, 3), (3, 4), (1, 5), (1, 6)], np.int32)
    net = Net(points, np.ones(7), wires, np.zeros(0, np.int32), np.full(7, 1 / 7))

    def steps():
        name = next(name for name, chain in net.branches.items() if 2 in chain)
        net.cut(name, range(len(net.branches[name])))
        yield
        net.drop_leaf(next(name for name in net.leaves() if 5 in net.branches[name]))
        yield

    found = recorded(net, steps())
    assert found.count == 2
    kept = [{tuple(pair) for pair in found.after(k).tolist()} for k in range(3)]
    assert kept[0] == {tuple(pair) for pair in wires.tolist()}
    assert kept[1] == {(1, 3), (3, 4), (1, 5), (1, 6)}
    assert kept[2] == {(1, 3), (3, 4), (1, 6)}


def test_a_filled_loop_leads_its_branches_to_the_centre():
    points = np.array([(0, 0, 0), (1, 1, 0), (1, -1, 0), (2, 0, 0), (3, 0, 0)], float)
    wires = np.array([(0, 1), (1, 3), (0, 2), (2, 3), (3, 4)], np.int32)
    net = Net(points, np.ones(5), wires, np.zeros(0, np.int32), np.full(5, 0.2))

    def steps():
        net.contract([name for name, chain in net.branches.items() if 4 not in chain], 1)
        yield

    found = recorded(net, steps())
    assert found.after(1).tolist() == [[1, 4]] and len(found.after(0)) == 5


def test_points_that_facets_hold_are_no_tips():
    points = np.array([(x, 0, 0) for x in range(5)] + [(2, 1, 0)], float)
    wires = np.array([(0, 1), (1, 2), (2, 3), (3, 4), (2, 5)], np.int32)
    net = Net(points, np.ones(6), wires, np.zeros(0, np.int32), np.zeros(6), anchored=[0, 3])
    assert sorted(net.tips()) == [4, 5]
    assert sorted(net.branches.values()) == [[0, 1, 2], [2, 3], [2, 5], [3, 4]]
    assert [net.branches[name] for name in net.leaves()] == [[2, 5], [3, 4]]


@pytest.mark.parametrize("closed", [False, True])
def test_waves_shorter_than_the_ball_go_and_ends_stay(closed):
    angle = np.linspace(0, 2 * np.pi if closed else np.pi, 401)
    wave = 1 + 0.05 * np.cos(40 * angle)
    line = np.column_stack((wave * np.cos(angle), wave * np.sin(angle), 0 * angle))
    if closed:
        line[-1] = line[0]
    course = Course(line, np.full(401, 0.3), closed)
    (share, places), again = smooth_between([course, course])
    np.testing.assert_allclose(again[1], places, rtol=0, atol=1e-12)
    ((_, alone),) = smooth_between([course])
    np.testing.assert_allclose(alone, places, rtol=0, atol=1e-12)
    radius = np.linalg.norm(places, axis=1)
    inner = radius if closed else radius[len(radius) // 5 : -len(radius) // 5]
    assert np.abs(inner - 1).max() < 0.004 and len(share) == len(places)
    ends = (places[0], places[0]) if closed else (line[0], line[-1])
    assert np.array_equal(places[[0, -1]], ends)


@pytest.mark.parametrize("detail", DETAILS)
@pytest.mark.parametrize("name", ["tongs", "torus"])
def test_a_skeleton_starts_from_the_curve_that_is_seen(curves, name, detail):
    """It has its loops, and its tips but for branches between forks whose balls nearly agree."""
    computation, smooth, _ = curves[name]
    axis, settings = smooth[detail], replace(computation.settings, detail=detail)
    shape = shape_of(SOLIDS[name][0]())
    found = compute_skeleton(shape, settings, SkeletonSettings(), shown=settings)
    assert (found.skeleton.tips, found.skeleton.loops) == (
        tips(axis, axis.edges),
        axis.level.betti[1],
    )
    assert (found.loops.cut + found.loops.filled == 0) == (detail == 1.0 or name == "torus")


def test_removals_are_found_once_for_all_details(curves, monkeypatch):
    computation = curves["tongs"][0]
    key, settings = computation.key, computation.settings
    refilter(key, replace(settings, detail=0.5))
    monkeypatch.setattr("medial_axis.core.axis.detail.removals_of", None)
    refilter(key, replace(settings, detail=0.25))
    with pytest.raises(TypeError):
        refilter(key, replace(settings, detail=0.25, limb=0.0))
