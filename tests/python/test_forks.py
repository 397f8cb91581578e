# SPDX-License-Identifier: GPL-3.0-or-later
"""Smooth curves go through their forks without a kink, and stay where a line would leave the solid."""

from dataclasses import replace

import numpy as np
import pytest
from medial_axis.core.axis import levels
from medial_axis.core.axis.compute import compute_axis
from medial_axis.core.axis.extract import extract
from medial_axis.core.axis.smooth_curve import smooth_curve
from medial_axis.core.curves.net import chains
from medial_axis.core.curves.smooth_line import marks_of
from medial_axis.core.curves.through_forks import Way, ways_through
from medial_axis.core.settings import Form, SamplingMode, Settings
from medial_axis.core.shape.shape import Shape
from support.levels import betti_of_mesh
from support.meshes import capsule, join, torus

# A bar with a branch, which draws the fork of the wires off the line of the bar.
TEE = join(capsule((-2, 0, 0), (2, 0, 0), 0.4), capsule((0, 0, 0), (0, 1.6, 0), 0.4))
RING_WITH_A_TAIL = join(torus(), capsule((1, 0, 0), (2.6, 0, 0), 0.3))
SOLIDS = {"tee": (TEE, 1, 3), "ring": (RING_WITH_A_TAIL, 0, 1)}


@pytest.fixture(scope="module")
def curves():
    """{solid: (curve along the wires, smooth curve, distances from the surface, whether places are inside)}."""
    found = {}
    for name, (solid, *_) in SOLIDS.items():
        settings = Settings(form=Form.CURVE, sampling=SamplingMode.SURFACE, samples=4_000, seed=1)
        computation = compute_axis(Shape(*solid), settings)
        asked = {}

        def spy(axis, depth, inside, asked=asked):
            asked["of"] = axis, depth, inside
            return axis

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(levels, "smooth_curve", spy)
            extract(computation.chosen.samples, computation.settings)
        axis, depth, inside = asked["of"]
        found[name] = axis, smooth_curve(axis, depth, inside), depth, inside
    return found


def wires_at_forks(axis):
    """{fork: its wires, which begin there}."""
    at = {}
    for chain in chains(axis.edges, len(axis.vertices)):
        at.setdefault(chain[0], []).append(chain)
        at.setdefault(chain[-1], []).append(chain[::-1])
    return {node: wires for node, wires in at.items() if len(wires) > 2}


def turns(axis, radii):
    """The turn in degrees of the straightest way through each fork, by chords of so many radii."""
    found = []
    for node, wires in wires_at_forks(axis).items():
        away = []
        for chain in wires:
            points = axis.vertices[chain]
            marks = marks_of(points)
            place = [np.interp(radii * axis.radius[node], marks, column) for column in points.T]
            away.append((place - points[0]) / np.linalg.norm(place - points[0]))
        turn = min(float(np.dot(a, b)) for i, a in enumerate(away) for b in away[:i])
        found.append(np.degrees(np.arccos(-turn)))
    return found


@pytest.mark.parametrize("name", SOLIDS)
def test_there_is_no_kink_at_a_fork(curves, name):
    wires, smooth, _, _ = curves[name]
    assert len(turns(smooth, 0.25)) == len(turns(wires, 0.25)) == 1
    assert turns(wires, 0.25)[0] > 20.0  # else the test sees nothing
    assert turns(smooth, 0.25)[0] < 12.0


@pytest.mark.parametrize("name", SOLIDS)
def test_topology_and_tips_stay(curves, name):
    wires, smooth, _, _ = curves[name]
    _, euler, tips = SOLIDS[name]
    for axis in (wires, smooth):
        assert betti_of_mesh(axis, axis.edges) == (1, euler)
        assert len(set(map(frozenset, axis.edges.tolist()))) == len(axis.edges)
    ends = [axis.vertices[np.bincount(axis.edges.ravel()) == 1] for axis in (wires, smooth)]
    assert len(ends[0]) == tips and sorted(map(tuple, ends[0])) == sorted(map(tuple, ends[1]))


@pytest.mark.parametrize("name", SOLIDS)
def test_a_fork_stays_in_its_ball_and_has_the_radius_of_its_place(curves, name):
    wires, smooth, depth, _ = curves[name]
    (old,), (new,) = wires_at_forks(wires), wires_at_forks(smooth)
    way = np.linalg.norm(smooth.vertices[new] - wires.vertices[old])
    assert 0.0 < way <= 0.5 * wires.radius[old]
    there, before = depth(np.stack((smooth.vertices[new], wires.vertices[old])))
    assert smooth.radius[new] - wires.radius[old] == pytest.approx(there - before, abs=1e-12)


def test_a_wire_that_would_leave_the_solid_holds_its_fork(curves):
    wires, _, depth, _ = curves["tee"]
    smooth = smooth_curve(wires, depth, lambda places: places[:, 1] < 1.0)
    (old,), (new,) = wires_at_forks(wires), wires_at_forks(smooth)
    assert np.array_equal(smooth.vertices[new], wires.vertices[old])
    assert betti_of_mesh(smooth, smooth.edges) == (1, 1)
    same = set(map(tuple, wires.vertices)) & set(map(tuple, smooth.vertices))
    branch = next(chain for chain in wires_at_forks(wires)[old] if wires.vertices[chain[-1], 1] > 1)
    assert {tuple(row) for row in wires.vertices[branch]} <= same
    assert len(same) == len(branch) + 2  # besides only the two other tips


def test_facets_hold_what_they_touch(curves):
    """A fork on a facet stays; the facet is made by hand of the fork and two tips."""
    wires, _, depth, inside = curves["tee"]
    (fork,) = wires_at_forks(wires)
    tips = np.flatnonzero(np.bincount(wires.edges.ravel()) == 1)[:2]
    facet = np.array([fork, *tips], np.int32)
    held = replace(wires, face_offsets=np.array([0, 3], np.int32), face_vertices=facet)
    smooth = smooth_curve(replace(held, structure=None), depth, inside)
    assert np.array_equal(smooth.vertices[smooth.face_vertices], wires.vertices[facet])


# --- ways


def star(*angles, spokes=4):
    """Wires from one point in the plane, at angles in degrees."""
    points, wires = [(0.0, 0.0, 0.0)], []
    for angle in np.radians(angles):
        row = len(points)
        points += [(k * np.cos(angle), k * np.sin(angle), 0.0) for k in range(1, spokes)]
        wires.append([0, *range(row, row + spokes - 1)])
    return wires, np.array(points), np.ones(len(points))


def test_the_straightest_two_of_three_wires_are_one_way():
    wires, points, radius = star(0, 90, 170)
    found = ways_through(wires, points, radius, set())
    assert found == [Way([(0, True), (2, False)], False), Way([(1, False)], False)]
    assert len(ways_through(wires, points, radius, {0})) == 3


def test_a_fork_of_equal_angles_is_no_line():
    assert len(ways_through(*star(5, 124, 246), set())) == 3


def test_a_loop_through_a_fork_is_closed():
    """A wire from the fork to itself, which leaves it and comes back in one line, and a wire aside."""
    points = np.array([(0, 0, 0), (1, 0.3, 0), (0.0, 2, 0), (-1, 0.3, 0), (0, -1, 0)], float)
    wires = [[0, 1, 2, 3, 0], [0, 4]]
    found = ways_through(wires, points, np.ones(5), set())
    assert found == [Way([(0, False)], True), Way([(1, False)], False)]


def test_two_wires_between_two_forks_are_a_closed_way():
    """A ring with a tail at each side."""
    angle = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    ring = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    points = np.concatenate((ring, [(2, 0, 0), (-2, 0, 0)]))
    wires = [[0, 1, 2, 3, 4, 5, 6], [6, 7, 8, 9, 10, 11, 0], [0, 12], [6, 13]]
    found = ways_through(wires, points, np.full(14, 0.3), set())
    assert [(way.closed, len(way.wires)) for way in found] == [(True, 2), (False, 1), (False, 1)]


def test_points_in_one_place_and_huge_ones_have_ways():
    wires, points, radius = star(0, 90, 170)
    assert len(ways_through(wires, 0 * points, radius, set())) == 3
    large = ways_through(wires, 1e200 * points, 1e200 * radius, set())
    assert large == ways_through(wires, points, radius, set())
